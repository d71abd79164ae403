#pragma once
// Growing: a shape goes in, a coat grows on it, a mesh with colours comes out.
//
//   pelage::TriangleMesh coat = pelage::grow(pelage::load_shape("cow.obj"), pelage::load_recipe("demo"));
//
// or step by step:
//
//   pelage::Growth growth(pelage::load_shape("cow.obj"), pelage::load_recipe("demo"));
//   while (!growth.done()) growth.advance(10);
//   pelage::save(growth.dress(), "cow.glb");
//
// All errors are pelage::Error, see error.h.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pelage/error.h"
#include "pelage/grid.h"
#include "pelage/progress.h"
#include "pelage/recipe.h"
#include "pelage/run_summary.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// The built-in recipe of that name, or the one in the file when the name ends in .toml. Error(Fault::usage) for an
/// unknown name, Error(Fault::input) for a file that cannot be read, Error(Fault::usage), located, for faults in it.
Recipe load_recipe(const std::string& name_or_path);

/// The built-in recipes.
std::vector<std::string> recipe_names();

/// The finished coat of a recipe on a shape, as Growth::dress() gives it. Errors as those of Growth.
TriangleMesh grow(const TriangleMesh& shape, const Recipe& recipe, const Progress& progress = {});

/// A coat that grows. Not copyable; use it from one thread at a time (it uses several itself).
class Growth {
 public:
  /// Resolves all names of the recipe and builds matrices and initial state: most errors come here. The shape is one
  /// that load_shape() or check_shape() gave (io.h). `progress` is told of this, and of every step in advance().
  Growth(TriangleMesh shape, const Recipe& recipe, const Progress& progress = {});
  /// The same on a grid, which neither moves nor is split.
  Growth(Grid grid, const Recipe& recipe, const Progress& progress = {});
  ~Growth();
  Growth(Growth&&) noexcept;
  Growth& operator=(Growth&&) noexcept;

  bool done() const;
  /// Fraction of the way to the end, as far as it is known.
  double fraction() const;
  /// Up to `steps` steps of time; fewer if the coat is done before. Error(Fault::numerics) when the fields blow up.
  /// Error(Fault::cancelled) when `progress` asks to stop: the coat is then as it was after the last whole step, and
  /// may be dressed, saved as a checkpoint, or grown on.
  void advance(std::int64_t steps);

  /// The stage in progress, or the last one.
  struct StagePlace {
    std::size_t number = 0;  ///< from 0
    std::size_t count = 1;   ///< of all stages
    std::string name;
  };
  StagePlace stage() const;
  /// How that stage stands.
  const RunSummary& summary() const;
  /// Whether no species of that stage shows a pattern; and what is likely to have kept it away, in words, empty if
  /// there is one.
  bool uniform() const;
  std::string why_uniform() const;
  /// What may spoil the coat, or was done otherwise than asked: a step beyond what the stepper stands, more anisotropy
  /// than the mesh carries, another method because of the mesh.
  const std::vector<std::string>& warnings() const;

  /// The coat as it stands, on the limit surface or the shape's own triangles as the look says: points, "normal",
  /// "color" (linear light) and one attribute per species, those of earlier stages as "STAGE_SPECIES". Default: the
  /// look of the recipe. What a look does not change is made once, so that the second one costs little.
  /// Error(Fault::usage), located, for faults in the look.
  TriangleMesh dress() const;
  TriangleMesh dress(const Look& look) const;
  /// The same at the nodes of the grid, as its attributes. Error(Fault::usage) on surfaces.
  Grid dress_grid() const;

  struct Field {
    std::string name;            ///< of the species, "STAGE.SPECIES" for earlier stages
    std::vector<double> values;  ///< concentrations at the vertices of dress()
  };
  std::vector<Field> fields() const;

  /// Everything that changes, as bytes: another Growth of the same shape and recipe that restores them goes on with
  /// the same bits, on any machine that rounds the same.
  std::string checkpoint() const;
  /// Error(Fault::input) when the bytes are not a checkpoint of this shape and recipe; the coat is then as before.
  void restore(const std::string& bytes);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage
