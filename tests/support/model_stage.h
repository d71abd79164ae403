#pragma once
// A stage of a built-in model as its file suggests it, for tests that make their programs themselves.

#include "catalog/models.h"
#include "react/wavelength.h"
#include "run/program.h"

namespace pelage {

/// At a wavelength of `size` [world units].
inline StageProgram stage_of(const std::string& model, const StepperKind& stepper, double size) {
  StageProgram stage;
  const ModelSource source = load_model(model);
  stage.model = compile(source);
  stage.stepper = &stepper;
  stage.size = size;
  stage.length_unit = size / model_wavelength(stage.model);
  stage.suggested_step = source.suggestions.step.value();
  stage.until = source.suggestions.end.value();
  stage.stationary = source.suggestions.tolerance.value();
  return stage;
}

}  // namespace pelage
