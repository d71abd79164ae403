#pragma once
// Runs on the unit sphere, whose unit is that of the model.

#include <filesystem>
#include <fstream>
#include <string>

#include "catalog/bind.h"
#include "run/run.h"
#include "shape/generators.h"
#include "support/steppers.h"

namespace pelage::test {

/// Of a model with these species.
inline Run run_on_unit_sphere(const std::string& species, const std::string& stepper, double step, double until) {
  const auto path = std::filesystem::temp_directory_path() / "pelage_sphere_run.toml";
  std::ofstream(path) << "name = 'test'\ntitle = 't'\ncite = 'c'\nsummary = 's'\nwavelength = 1.3\n" << species << "\n";
  Recipe recipe;
  recipe.stages[0].model.value = path.string();
  recipe.stages[0].method.value = stepper_named(stepper).nodal ? "remeshed" : "loop";
  recipe.stages[0].stepper.value = stepper;
  recipe.stages[0].size = Given<Length>{{1.3, Length::Unit::world}, {}};
  recipe.stages[0].step = step;
  recipe.stages[0].until = until;
  recipe.stages[0].interpolate = true;
  return Run(make_program(recipe, builtin_shape("builtin:sphere?n=642")));
}

}  // namespace pelage::test
