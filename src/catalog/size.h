#pragma once
// How large the pattern of a stage becomes in the world.

#include "pelage/recipe.h"
#include "react/model.h"

namespace pelage {

/// In world units, on a shape whose bounding box has this diagonal.
double world_length(const Length& length, double diagonal);

/// In world units.
struct StageSize {
  double wavelength = 0;   ///< spacing of the pattern
  double length_unit = 0;  ///< of the model: wavelength / model_wavelength()
};

/// What the stage's `size` or `unit` asks of its model, compiled with the numbers of the stage; the plain value of a
/// parameter that a formula replaces counts. Error(usage), located, when both are given, and for a model whose
/// wavelength is unknown.
StageSize stage_size(const Stage& stage, const Model& plain, double diagonal);

}  // namespace pelage
