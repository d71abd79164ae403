// The spacing is the one that was asked for, whatever the parameters. The identities behind it are in
// tests/react/wavelength_test.cpp, and docs/models.md has the figures of all models; here are runs of each kind.
#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "shape/generators.h"
#include "verify/finished_pattern.h"

namespace pelage {
namespace {

struct Case {
  std::string model;
  std::vector<Stage::Setting> parameters;
};

/// Spacing of the finished pattern on the unit sphere over the size that was asked for.
double spacing_over_size(const Case& c, double size) {
  Recipe recipe;
  Stage& stage = recipe.stages[0];
  stage.model.value = c.model;
  stage.parameters = c.parameters;
  stage.size = Given<Length>{{size, Length::Unit::world}, {}};
  const Program program = make_program(recipe, builtin_shape("builtin:sphere?n=642"));
  const double unit = program.stages[0].length_unit;
  return finish_pattern(program).wavelength * unit / size;
}

TEST(Scaling, SpacingIsTheSizeWhateverTheParameters) {
  const std::vector<Case> cases = {
      {"meinhardt-stripes", {{"Dg", 0.008, {}}, {"Ds", 0.06, {}}}},  // ratio of linear waves
      {"schnakenberg", {{"d", 80, {}}}},
      {"witkin-kass-stripes", {{"s", 2, {}}}},  // formula of the papers
      {"witkin-kass", {{"b", 2, {}}}},          // fitted formulas
      {"gray-scott", {{"Du", 0.4194, {}}}},
      {"gray-scott:spots", {{"Dv", 0.05245, {}}}},
      {"ohta-kawasaki", {{"sigma", 0.05, {}}}},
  };
  for (const Case& c : cases) EXPECT_NEAR(spacing_over_size(c, 0.9), 1, 0.25) << c.model;
}

}  // namespace
}  // namespace pelage
