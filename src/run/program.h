#pragma once
// A recipe with its names resolved: everything that a run needs, checked before any work.

#include <optional>

#include "direction/guides.h"
#include "fair/fair.h"
#include "pelage/recipe.h"
#include "pelage/triangle_mesh.h"
#include "react/model.h"
#include "run/place_fields.h"

namespace pelage {

/// How the vertices of the shape move during a run.
struct SurfaceMotion {
  std::optional<FairOptions> fair;
  double growth = 0;       ///< of all lengths about the middle of the bounding box [1 / model time]
  bool physical = false;   ///< amounts ride along with the surface, not values
  std::int64_t every = 1;  ///< time steps between two moves

  bool any() const { return fair || growth != 0; }
};

/// One stage.
struct Program {
  TriangleMesh shape;             ///< repaired control mesh; of later stages empty: they go on with that of the first
  std::vector<Texture> textures;  ///< laid on the shape by its "uv"
  std::string name;               ///< of the stage
  Model model;
  std::string model_name;  ///< as the recipe gives it, with its variant
  std::string method;      ///< of discretisation
  std::string stepper;
  double size = 0;             ///< wanted wavelength [world units]
  double length_unit = 0;      ///< world length of one model length unit: size / the model's wavelength
  std::optional<double> step;  ///< fixed step; else the stepper's choice
  double suggested_step = 0;
  double resolution = 6;                ///< control vertices per wavelength, at least
  bool excluded = false;                ///< what the model holds is cut out: no flux passes its border
  std::optional<FieldWish> directions;  ///< of anisotropic diffusion; default: attribute "direction", or the smoothest
  std::optional<double> points;         ///< spacing of the random points that attribute(points) tells the distance to
  std::optional<double> edge;  ///< longest edge [world units] where another stage asks for shorter ones than this
  std::optional<int> levels;   ///< refine the shape so often, whatever the sizes
  VertexAttributes fields;     ///< finished fields of earlier stages, "STAGE.SPECIES", at the refined vertices
  double until = 0;            ///< model time
  std::optional<std::int64_t> steps;
  double stationary = 0;  ///< 0: never
  std::uint64_t seed = 1;
  bool interpolate = false;
  SurfaceMotion motion;
};

/// "STAGE.SPECIES", by which formulas find the field of an earlier stage.
std::string field_name(const std::string& stage, const std::string& species);

/// Length of the diagonal of the bounding box.
double bounding_diagonal(const TriangleMesh& mesh);

}  // namespace pelage
