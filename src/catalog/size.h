#pragma once
// How large the pattern of a stage becomes in the world.

#include "pelage/recipe.h"

namespace pelage {

/// Default of Stage::size, as a fraction of the diagonal.
inline constexpr double default_size = 0.04;

/// In world units, on a shape whose bounding box has this diagonal.
double world_length(const Length& length, double diagonal);

/// In world units.
struct StageSize {
  double wavelength = 0;   ///< spacing of the pattern
  double length_unit = 0;  ///< of the model: `wavelength` over that in model length units
};

/// Error(usage), located, when a stage has both a size and a unit.
void require_one_size(const Stage& stage);

/// What the stage's `size` or `unit` asks of a model with this wavelength [model length units].
StageSize stage_size(const Stage& stage, double model_wavelength, double diagonal);

}  // namespace pelage
