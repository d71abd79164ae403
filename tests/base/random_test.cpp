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

/// A period further on and further back; the places are exact in binary.
TEST(SmoothNoise, RepeatsOnBothSidesOfZero) {
  constexpr std::array<double, 3> period = {1, 2, 0.5};
  const auto at = [&](double turns) {
    return smooth_noise({0.3125 + turns, 0.8125 + 2 * turns, 0.1875 + 0.5 * turns}, 0.125, 7, period);
  };
  for (const double turns : {-3.0, -1.0, 1.0}) EXPECT_EQ(at(turns), at(0));
}

}  // namespace
}  // namespace pelage
