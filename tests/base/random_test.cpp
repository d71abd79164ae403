#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelage {
namespace {

/// Lattice points have numbers up to 2^62; places beyond share the last one.
TEST(SmoothNoise, HasAValueAtAnyDistance) {
  for (const double far : {1e15, 1e18, 1e19, 1e300, -1e18, -1e19, -1e300}) {
    EXPECT_TRUE(std::isfinite(smooth_noise({far, 0, 0}, 1, 1))) << far;
    EXPECT_TRUE(std::isfinite(smooth_noise({0.5, far, far}, 1e-3, 1))) << far;
  }
  EXPECT_EQ(smooth_noise({1e19, 0.3, 0}, 1, 1), smooth_noise({1e300, 0.3, 0}, 1, 1));
  EXPECT_NE(smooth_noise({1e18, 0.3, 0}, 1, 1), smooth_noise({1e300, 0.3, 0}, 1, 1));
}

}  // namespace
}  // namespace pelage
