#pragma once
// How large the pattern of a stage becomes in the world.

#include "base/box.h"
#include "pelage/io.h"
#include "pelage/recipe.h"

namespace pelage {

/// Default of Stage::size, as a fraction of the diagonal.
inline constexpr double default_size = 0.04;

/// What lengths of a recipe refer to.
struct ShapeScale {
  double diagonal = 0;                    ///< of the bounding box [world units]
  double longest = 0;                     ///< side of it
  Point middle{};                         ///< of it
  std::optional<double> metres_per_unit;  ///< nothing where nobody knows
  std::optional<double> cell;  ///< mean distance of neighbours among given nodes [world units]; nothing on surfaces
};

ShapeScale scale_of(const Box& box, const std::optional<double>& metres_per_unit);
ShapeScale scale_of(const TriangleMesh& shape);
/// `mesh` is that of the nodes.
ShapeScale scale_of(const NodeShape& nodes, const TriangleMesh& mesh);
ShapeScale scale_of(const ShapeFile& shape);

/// In world units. Error(usage), located, for metres on a shape whose unit nobody knows, and for cells on a surface.
double world_length(const Given<Length>& length, const ShapeScale& scale);

/// In world units.
struct StageSize {
  double wavelength = 0;   ///< spacing of the pattern
  double length_unit = 0;  ///< of the model: `wavelength` over that in model length units
};

/// Error(usage), located, for a length above the whole diagonal: most likely its unit was forgotten.
void require_fraction(const char* what, const std::optional<Given<Length>>& length);

/// Error(usage), located, when a stage has both a size and a unit, and for lengths above the whole diagonal.
void require_sizes(const Stage& stage);

/// What the stage's `size` or `unit` asks of a model with this wavelength [model length units]. Errors of world_length.
StageSize stage_size(const Stage& stage, double model_wavelength, const ShapeScale& scale);

}  // namespace pelage
