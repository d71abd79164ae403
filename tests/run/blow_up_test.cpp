#include "run/blow_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "catalog/bind.h"
#include "run/run.h"
#include "shape/generators.h"
#include "support/steppers.h"

namespace pelage {
namespace {

/// The message of a run on a sphere that fails.
std::string failure(const std::string& species, const std::string& stepper = "", double step = 0,
                    const std::string& shape = "builtin:sphere?n=642") {
  Recipe recipe;
  recipe.models["own"].text = "name = \"own\"\nwavelength = 1\n" + species;
  Stage& stage = recipe.stages[0];
  stage.model.value = "own";
  stage.size = Given<Length>{{0.3}, {}};
  stage.stepper.value = stepper;
  if (step > 0) stage.step = step;
  Run run(make_program(recipe, builtin_shape(shape)));
  run.advance(100000);
  EXPECT_EQ(run.summary().status, RunStatus::failed) << species;
  return run.summary().message;
}

/// The three numbers in brackets.
Point place_of(const std::string& message) {
  std::string text = message.substr(message.find('(') + 1);
  std::ranges::replace(text, ',', ' ');
  Point p{};
  std::istringstream(text) >> p[0] >> p[1] >> p[2];
  return p;
}

/// The number behind the text.
double number_after(const std::string& message, const std::string& text) {
  const std::size_t at = message.find(text);
  EXPECT_NE(at, std::string::npos) << message;
  return at == std::string::npos ? NAN : std::stod(message.substr(at + text.size()));
}

const std::string peak = "2*exp(-20*((x - 0.6)^2 + y^2 + (z - 0.8)^2))";

/// u' = u^2 ends at once where u is largest.
TEST(BlowUp, IsNamedWithSpeciesValueVertexAndPlace) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=642");
  for (const std::string& stepper : stepper_names()) {
    if (stepper == "semi-implicit") continue;  // 1 / (1 - dt u) goes on beyond the pole, with a warning
    const std::string message = failure("[species.u]\ndiffusion = \"0\"\nrate = \"u^2\"\ninitial = \"" + peak + "\"\n",
                                        stepper, stepper == "explicit" || stepper == "paper" ? 0.1 : 0);
    const Point p = place_of(message);
    EXPECT_NEAR(p[0], 0.6, 0.15) << message;
    EXPECT_NEAR(p[1], 0, 0.15) << message;
    EXPECT_NEAR(p[2], 0.8, 0.15) << message;
    const auto vertex = static_cast<std::size_t>(number_after(message, " at vertex "));
    ASSERT_LT(vertex, sphere.points.size());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sphere.points[vertex][k], p[k], 0.15) << message;
    EXPECT_TRUE(message.find("u is ") != std::string::npos || message.find("u becomes ") != std::string::npos)
        << message;
    EXPECT_EQ(message.find("negative"), std::string::npos) << message;
  }
}

TEST(BlowUp, OfASpeciesThatTurnedNegativeAsksForABound) {
  // Without u below 0 this would rest at 0: u' = -u^2 - u with a push that ends.
  const std::string rate = "\ndiffusion = \"1\"\nrate = \"-u - u^2 - 3*step(t, 1)\"\n";
  const std::string message = failure("[species.u]" + rate + "initial = \"0.1 + " + peak + "\"\n");
  EXPECT_NE(message.find("u went negative: give it min = 0"), std::string::npos) << message;
  EXPECT_LT(number_after(message, "; u is "), 0) << message;
  const std::string noisy = failure("[species.u]" + rate + "initial = \"0.3 + 0.5*z\"\n");
  EXPECT_NE(noisy.find("u began below 0 in places and went negative: give it min = 0"), std::string::npos) << noisy;
  // One that swings about 0 may be there.
  const std::string signed_one = failure("[species.u]" + rate + "initial = \"-0.1*x\"\n");
  EXPECT_EQ(signed_one.find("went negative"), std::string::npos) << signed_one;
}

TEST(BlowUp, NamesTheSpeciesThatTurnedNegativeAndDroveAnother) {
  const std::string message = failure(
      "[species.w]\ndiffusion = \"1\"\nrate = \"w^2 - 5*w*u\"\ninitial = \"1\"\n"
      "[species.u]\ndiffusion = \"1\"\nrate = \"-1\"\ninitial = \"0.5\"\n");
  EXPECT_NE(message.find("; w "), std::string::npos) << message;
  EXPECT_NE(message.find("u went negative: give it min = 0"), std::string::npos) << message;
}

/// Only where x > 0.9 there is no root, from time 1 on.
TEST(BlowUp, WhatIsNoNumberIsCalledSo) {
  for (const std::string stepper : {"", "sbdf2", "explicit"}) {
    const std::string message =
        failure("[species.u]\ndiffusion = \"0\"\nrate = \"sqrt(1 - t*step(0.9, x))\"\ninitial = \"1\"\n", stepper, 0.3);
    EXPECT_NE(message.find("nan at vertex"), std::string::npos) << message;
    EXPECT_NE(message.find("look for a division by 0, or a root"), std::string::npos) << message;
    EXPECT_GT(place_of(message)[0], 0.85) << message;
  }
}

TEST(BlowUp, NamesTheStage) {
  Recipe recipe;
  recipe.models["own"].text =
      "name = \"own\"\nwavelength = 1\n[species.u]\ndiffusion = \"1\"\nrate = \"u^2\"\ninitial = \"1\"\n";
  recipe.stages.resize(2);
  recipe.stages[0].steps = 1;
  recipe.stages[1].model.value = "own";
  for (Stage& stage : recipe.stages) stage.size = Given<Length>{{0.5}, {}};
  recipe.stages[0].name.value = "first";
  recipe.stages[1].name.value = "second";
  pelage::Run run(make_program(recipe, builtin_shape("builtin:sphere?n=362")));
  run.advance(100000);
  EXPECT_TRUE(run.summary().message.starts_with("stage second, step ")) << run.summary().message;
}

}  // namespace
}  // namespace pelage
