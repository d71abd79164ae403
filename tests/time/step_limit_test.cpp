#include "time/step_limit.h"

#include <gtest/gtest.h>

#include "catalog/models.h"

namespace pelage {
namespace {

TEST(StepLimit, SemiImplicitEulerOfTheTuringSystemStopsAtOneOverTwentyEightS) {
  const Model turing = compile(load_model("turing"));  // s = 0.05
  EXPECT_NEAR(largest_stable_step(turing, semi_implicit, 100) * 0.05, 1.0 / 28, 1e-4);
}

TEST(StepLimit, SemiImplicitBackwardDifferencesStandTenTimesMore) {
  const Model turing = compile(load_model("turing"));
  EXPECT_NEAR(largest_stable_step(turing, sbdf2, 100) * 0.05, 0.344, 2e-3);
}

TEST(StepLimit, ExplicitStepIsBoundByDiffusionOnAFineMesh) {
  const Model turing = compile(load_model("turing"));  // largest diffusion 1/8
  EXPECT_NEAR(largest_stable_step(turing, explicit_euler, 1000), 2 / (0.125 * 1000), 1e-3);
}

/// Around u = 0 and at -1 on the unit circle: 4 + h mu^2 = 3 h (1 - r - 2 mu), worst at mu = 0.
TEST(StepLimit, SwiftHohenbergIsBoundByItsReaction) {
  const Model model = compile(load_model("swift-hohenberg"), {{"r", -0.5}});
  EXPECT_NEAR(largest_stable_step(model, sbdf2, 1000), 4 / (3 * 1.5), 1e-3);
}

/// The implicit 2 lap(c) outweighs what is extrapolated.
TEST(StepLimit, CahnHilliardIsNotBound) {
  EXPECT_GT(largest_stable_step(compile(load_model("cahn-hilliard")), sbdf2, 1000), 100);
}

/// 2 / sigma of the shortest wave.
TEST(StepLimit, ExplicitStepOfAFourthOrderEquationFallsWithTheFourthPower) {
  const Model model = compile(load_model("swift-hohenberg"));
  EXPECT_NEAR(largest_stable_step(model, explicit_euler, 100) * (99.0 * 99.0 - 0.3), 2, 1e-3);
}

/// u flees from v, which follows it: lambda^2 + (1 + K) lambda + q K = 0 with K = k^2 and the coefficient q of the
/// flux. On the circle |1 + dt lambda| = 1 of complex lambda dt = (1 + K) / (q K).
TEST(StepLimit, ExplicitFluxesCount) {
  const Model model = compile(parse_model(
      "name='m'\nspecies.u={diffusion=0, rate='div(1000*u grad v)', initial=1}\nspecies.v={diffusion=1, rate='u - v', "
      "initial=1}",
      "m.toml"));
  EXPECT_NEAR(largest_stable_step(model, explicit_euler, 1000), 1001 / 1e6, 1e-6);
}

}  // namespace
}  // namespace pelage
