#pragma once
// The public face: a shape goes in, a coat grows on it, a mesh with colours comes out.
//
//   pelage::Growth growth(pelage::load_shape("cow.obj"), pelage::recipe("demo"));
//   while (!growth.done()) growth.advance(10);
//   pelage::save(growth.dress(), "cow.glb");
//
// All errors are pelage::Error, see error.h.

#include <memory>
#include <string>

#include "pelage/error.h"
#include "pelage/recipe.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// Reads an OBJ, PLY, STL, OFF, glTF or GLB file, or makes a "builtin:NAME?n=VERTICES", and repairs what is safe to
/// repair. Error(Fault::input), with the place in the file, for what is not.
TriangleMesh load_shape(const std::string& path_or_builtin);

/// The built-in recipe of that name, or the one in the file when the name ends in .toml.
Recipe recipe(const std::string& name_or_path);

/// A coat that grows. Not copyable; use it from one thread at a time (it uses several itself).
class Growth {
 public:
  /// Resolves all names of the recipe and builds matrices and initial state: most errors come here.
  Growth(TriangleMesh shape, const Recipe& recipe);
  ~Growth();
  Growth(Growth&&) noexcept;
  Growth& operator=(Growth&&) noexcept;

  bool done() const;
  /// Fraction of the way to the end, as far as it is known.
  double fraction() const;
  /// Up to `steps` steps of time; fewer if the coat is done before. Error(Fault::numerics) when the fields blow up.
  void advance(std::int64_t steps);
  /// The coat as it stands, on the limit surface or the shape's own triangles as the recipe's look says: points,
  /// "normal", "color" (linear light) and one attribute per species.
  TriangleMesh dress() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Writes a .glb, .ply, .obj, .vtp, .stl or .off file; it appears whole or not at all.
void save(const TriangleMesh& mesh, const std::string& path);

}  // namespace pelage
