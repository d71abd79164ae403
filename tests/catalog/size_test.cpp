#include "catalog/size.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/bind.h"
#include "catalog/models.h"
#include "react/wavelength.h"
#include "shape/generators.h"

namespace pelage {
namespace {

constexpr double diagonal = 50;

/// The stage of a recipe whose table holds these lines.
Stage stage_with(const std::string& lines) {
  return parse_recipe("[stage]\nmodel = \"witkin-kass-stripes\"\n" + lines, "r.toml").stages[0];
}

StageSize size_of(const std::string& lines, const Overrides& overrides = {}) {
  const Stage stage = stage_with(lines);
  require_one_size(stage);
  return stage_size(stage, model_wavelength(compile(load_model(stage.model.value), overrides)), diagonal);
}

TEST(StageSizes, ASizeIsTheSpacingWhateverTheParameters) {
  for (const double s : {0.5, 1.0, 2.0}) {
    const StageSize size = size_of("size = 0.1", {{"s", s}});
    EXPECT_EQ(size.wavelength, 5);
    EXPECT_DOUBLE_EQ(size.length_unit, 5 / (7.9 * s));
  }
  EXPECT_EQ(size_of("").wavelength, default_size * diagonal);
  EXPECT_EQ(size_of("size = \"2u\"").wavelength, 2);
}

TEST(StageSizes, AUnitLetsTheParametersSetTheSpacing) {
  for (const double s : {0.5, 1.0, 2.0}) {
    const StageSize size = size_of("unit = \"3u\"", {{"s", s}});
    EXPECT_EQ(size.length_unit, 3);
    EXPECT_DOUBLE_EQ(size.wavelength, 3 * 7.9 * s);
  }
  EXPECT_DOUBLE_EQ(size_of("unit = 0.01").length_unit, 0.5);
}

TEST(StageSizes, BothAtOnceAreRefused) {
  try {
    size_of("size = 0.1\nunit = 0.01");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "r.toml:4:8: a stage has either a size or a unit, since one follows from the other");
  }
}

TEST(StageSizes, AUnitOfAMappedParameterTakesItsPlainValue) {
  const Recipe recipe = parse_recipe(
      "[stage]\nmodel = \"witkin-kass-stripes\"\nunit = 0.01\nparameters = { s = \"2 + bx\" }\n", "r.toml");
  TriangleMesh square = builtin_shape("builtin:plane?n=100");
  for (Point& p : square.points)
    for (double& x : p) x *= diagonal / std::sqrt(2.0);
  const StageProgram stage = make_program(recipe, square).stages[0];
  EXPECT_NEAR(stage.length_unit, 0.5, 1e-12);
  EXPECT_NEAR(stage.size, 0.5 * 7.9, 1e-11);
}

}  // namespace
}  // namespace pelage
