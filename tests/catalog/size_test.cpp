#include "catalog/size.h"

#include <gtest/gtest.h>

#include "catalog/models.h"
#include "catalog/resolve.h"
#include "react/wavelength.h"

namespace pelage {
namespace {

constexpr double diagonal = 50;

/// The stage of a recipe whose table holds these lines.
Stage stage_with(const std::string& lines) {
  return parse_recipe("[stage]\nmodel = \"witkin-kass-stripes\"\n" + lines, "r.toml").stages[0];
}

StageSize size_of(const std::string& lines, const Overrides& overrides = {}) {
  const Stage stage = stage_with(lines);
  return stage_size(stage, compile(load_model(stage.model.value), overrides), diagonal);
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
  TriangleMesh stand_in;
  stand_in.points = {{0, 0, 0}, {diagonal, 0, 0}};
  const std::vector<Program> stages = resolve(recipe, stand_in);
  EXPECT_DOUBLE_EQ(stages[0].length_unit, 0.5);
  EXPECT_DOUBLE_EQ(stages[0].size, 0.5 * 7.9);
}

}  // namespace
}  // namespace pelage
