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
#include "pelage/io.h"
#include "pelage/own_rates.h"
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

/// As read_shape() (io.h), and also grids for regions and sewn patches, from a .toml file or built in.
/// Error(Fault::usage), located, for faults in these.
ShapeFile find_shape(const std::string& path);

/// The finished coat of a recipe on a shape, as Growth::dress() gives it. Errors as those of Growth.
TriangleMesh grow(const TriangleMesh& shape, const Recipe& recipe, const Progress& progress = {});

/// A coat as square images on its shape: save() takes the mesh with SaveOptions::textures = {maps} and its `repeat`.
struct TexturedMesh {
  PolygonMesh mesh;
  TextureMaps maps;
  /// Of every texel from the top left corner: above the surface [world units], or, where the look says no height, the
  /// value of the species that is shown.
  std::vector<float> height;
  int size = 0;         ///< texels along a side
  bool repeat = false;  ///< uv beyond the image see it repeated
};

/// A coat that grows. Not copyable; use it from one thread at a time (it uses several itself).
class Growth {
 public:
  /// Resolves all names of the recipe and builds matrices and initial state: most errors come here. The shape is one
  /// that load_shape() or check_shape() gave (io.h). `progress` is told of this, and of every step in advance().
  Growth(TriangleMesh shape, const Recipe& recipe, const Progress& progress = {});
  /// The same on a grid, which neither moves nor is split.
  Growth(Grid grid, const Recipe& recipe, const Progress& progress = {});
  /// The same on whatever a file has: surfaces, clouds of points, grids, patches, volumes; what the recipe grows in
  /// volumes fills a surface. With `own`, its rates take the place of those of the model; Error(Fault::usage) for a
  /// stage that the recipe does not have, and for steppers that need formulas.
  Growth(ShapeFile shape, const Recipe& recipe, const Progress& progress = {}, const OwnRates& own = {});
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

  /// The coat on the faces of the shape's file, as a look has it that keeps the shape.
  PolygonMesh dress_in_file() const;
  /// The coat as images of so many texels along a side, on the uv of the shape or else on an atlas that is made for it.
  /// Error(Fault::usage) for shapes that are no surfaces, and uv of several images.
  TexturedMesh bake(int size) const;

  /// The nodes of the run: points, "normal", and triangles between them where there are any.
  TriangleMesh nodes() const;
  /// Of the stage in progress.
  std::vector<std::string> species() const;
  /// Concentrations of one of them at the nodes. Error(Fault::usage) for an unknown one.
  std::vector<double> values(const std::string& species) const;
  /// Replaces them. The steps begin anew from there, at the time that it is. Error(Fault::usage) for an unknown
  /// species, another number of values than nodes, and values that are not finite.
  void set_values(const std::string& species, const std::vector<double>& values);

  /// Everything that changes, as bytes: another Growth of the same shape and recipe that restores them goes on with
  /// the same bits, on any machine that rounds the same.
  std::string checkpoint() const;
  /// Error(Fault::input) when the bytes are not a checkpoint of this shape and recipe; the coat is then as before.
  void restore(const std::string& bytes);

 private:
  struct Parts;
  std::size_t species_number(const std::string& name) const;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage
