#pragma once
// A recipe bound to a shape: all that a run needs, with every name resolved and every fault found. Immutable once a run
// has it.

#include <memory>
#include <optional>

#include "direction/guides.h"
#include "discretise/method.h"
#include "pelage/fair.h"
#include "pelage/node_shape.h"
#include "pelage/own_rates.h"
#include "pelage/triangle_mesh.h"
#include "react/model.h"
#include "run/borders.h"
#include "shape/texture.h"
#include "shape/topology.h"
#include "time/stepper.h"

namespace pelage {

/// How the vertices of the shape move during a run.
struct SurfaceMotion {
  std::optional<FairOptions> fair;
  double growth = 0;       ///< of all lengths about the middle of the bounding box [1 / model time]
  bool physical = false;   ///< amounts ride along with the surface, not values
  std::int64_t every = 1;  ///< time steps between two moves

  bool any() const { return fair || growth != 0; }
};

struct StageProgram {
  std::string name;
  Model model;             ///< with what the stage changes in it
  std::string model_name;  ///< as the recipe gives it, with its variant
  const StepperKind* stepper = &sbdf2;
  const SolverKind* solver = &jacobi_gradients;
  std::int64_t refresh = 1;    ///< see StepRequest
  bool solver_asked = false;   ///< so that there have to be matrices to solve with
  double size = 0;             ///< wanted wavelength [world units]
  bool size_known = true;      ///< false: `size` is not a wavelength but what the mesh has to resolve
  double length_unit = 0;      ///< world length of one model length unit: size / the model's wavelength
  Point origin{};              ///< of random fields: the middle of the shape's box
  Point period{};              ///< of smooth ones along x, y and z, on periodic grids [world units]; 0: none
  std::optional<double> step;  ///< fixed step; else the stepper's choice
  double suggested_step = 0;
  bool excluded = false;                 ///< what the model holds is cut out: no flux passes its border
  std::vector<BorderCondition> borders;  ///< of grids
  std::optional<FieldWish> directions;   ///< of anisotropic diffusion; default: attribute "direction", or the smoothest
  std::string follows;           ///< what its directions follow, for people; empty without anisotropic diffusion
  std::optional<double> points;  ///< spacing of the random points that attribute(points) tells the distance to
  std::optional<double> jitter;  ///< of these points on flat grids, where they are a grid of diamonds
  double until = 0;              ///< model time
  std::optional<std::int64_t> steps;
  double stationary = 0;  ///< 0: never
  std::uint64_t seed = 1;
  decltype(OwnRates::rates) own_rates = {};  ///< instead of those of the model; empty: none
  std::optional<double> iterations;          ///< that it is likely to take; see RunSummary::iterations

  /// Whether the step follows the error.
  bool adaptive() const { return !step && stepper->adaptive; }
};

struct Program {
  std::shared_ptr<const TriangleMesh> shape;  ///< repaired control mesh; null where a run is given its space
  std::shared_ptr<const NodeShape> nodes;     ///< of which `shape` is the mesh; null on surfaces
  std::vector<Texture> textures;              ///< laid on the shape by its "uv"
  const Method* method = &loop_method;
  bool interpolate = false;   ///< the surface goes through the vertices of the shape
  Creases creases;            ///< of the shape, with its edges as make_topology numbers them
  double edge = 0;            ///< longest edge at the start [world units]
  std::vector<double> edges;  ///< the same at every vertex of the shape, where sizes differ; empty: `edge` everywhere
  double step_error = 1;      ///< factor on the local error that adaptive steppers keep
  SurfaceMotion motion;
  std::vector<StageProgram> stages;   ///< at least one
  std::vector<std::string> warnings;  ///< what was done otherwise than asked, each in one line
};

/// "STAGE.SPECIES", by which formulas find the field of an earlier stage.
inline std::string field_name(const std::string& stage, const std::string& species) { return stage + "." + species; }

}  // namespace pelage
