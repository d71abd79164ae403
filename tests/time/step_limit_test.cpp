#include "time/step_limit.h"

#include <gtest/gtest.h>

#include "catalog/models.h"

namespace pelage {
namespace {

TEST(StepLimit, PaperSchemeOfTheTuringSystemStopsAtOneOverTwentyEightS) {
  const Model turing = compile(load_model("turing"));  // s = 0.05
  EXPECT_NEAR(largest_stable_step(turing, "paper", 100) * 0.05, 1.0 / 28, 1e-4);
}

TEST(StepLimit, SemiImplicitBackwardDifferencesStandTenTimesMore) {
  const Model turing = compile(load_model("turing"));
  EXPECT_NEAR(largest_stable_step(turing, "sbdf2", 100) * 0.05, 0.344, 2e-3);
}

TEST(StepLimit, ExplicitStepIsBoundByDiffusionOnAFineMesh) {
  const Model turing = compile(load_model("turing"));  // largest diffusion 1/8
  EXPECT_NEAR(largest_stable_step(turing, "explicit", 1000), 2 / (0.125 * 1000), 1e-3);
}

}  // namespace
}  // namespace pelage
