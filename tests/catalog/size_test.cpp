#include "catalog/size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "catalog/bind.h"
#include "catalog/models.h"
#include "react/wavelength.h"
#include "shape/generators.h"

namespace pelage {
namespace {

constexpr double diagonal = 50;
const ShapeScale unknown{diagonal, 40, {}, {}, {}}, millimetres{diagonal, 40, {}, 0.001, {}};

/// The stage of a recipe whose table holds these lines.
Stage stage_with(const std::string& lines) {
  return parse_recipe("[stage]\nmodel = \"witkin-kass-stripes\"\n" + lines, "r.toml").stages[0];
}

StageSize size_of(const std::string& lines, const Overrides& overrides = {}, const ShapeScale& scale = unknown) {
  const Stage stage = stage_with(lines);
  require_sizes(stage);
  return stage_size(stage, model_wavelength(compile(load_model(stage.model.value), overrides)), scale);
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

std::string fault_of(const std::string& lines, const ShapeScale& scale = unknown) {
  try {
    size_of(lines, {}, scale);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    return error.what();
  }
  return "";
}

TEST(StageSizes, MetresBecomeUnitsOfTheShape) {
  for (const auto& [text, metres] : std::map<std::string, double>{
           {"4mm", 0.004}, {"2cm", 0.02}, {"0.1m", 0.1}, {"3in", 0.0762}, {"1ft", 0.3048}, {"0.5km", 500}}) {
    EXPECT_DOUBLE_EQ(size_of("size = \"" + text + "\"", {}, millimetres).wavelength, 1000 * metres) << text;
    EXPECT_DOUBLE_EQ(size_of("size = \"" + text + "\"", {}, {diagonal, 40, {}, 1.0, {}}).wavelength, metres) << text;
    EXPECT_DOUBLE_EQ(size_of("unit = \"" + text + "\"", {}, millimetres).length_unit, 1000 * metres) << text;
  }
  EXPECT_EQ(size_of("size = \"4u\"", {}, millimetres).wavelength, 4);
}

/// The figures of both readings, so that one can be chosen.
TEST(StageSizes, MetresOnAShapeOfUnknownUnitAreRefused) {
  EXPECT_EQ(fault_of("size = \"4mm\""),
            "r.toml:3:8: a length of 4 mm needs the unit of the shape, which its file does not say: it is 40 units "
            "across, 40 m or 40 mm; give --input-unit m or --input-unit mm");
  EXPECT_NE(fault_of("unit = \"0.1mm\""), "");
  EXPECT_EQ(fault_of("size = \"4u\""), "");
  const Recipe recipe = parse_recipe("[stage]\nmodel = \"turing\"\npoints = \"4mm\"\n", "r.toml");
  TriangleMesh shape = builtin_shape("builtin:plane?n=100");
  shape.metres_per_unit.reset();
  EXPECT_THROW(make_program(recipe, shape), Error);
  shape.metres_per_unit = 0.01;
  EXPECT_DOUBLE_EQ(*make_program(recipe, shape).stages[0].points, 0.4);
}

TEST(StageSizes, MoreThanTheWholeShapeIsNoFraction) {
  EXPECT_EQ(fault_of("size = 4"),
            "r.toml:3:8: size 4 is 4 diagonals of the shape; give a fraction of at most 1, or write 4u for 4 units of "
            "the file (4mm for millimetres)");
  EXPECT_NE(fault_of("unit = \"1.5\""), "");
  EXPECT_NE(fault_of("points = 3"), "");
  EXPECT_EQ(fault_of("size = 1"), "");
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
