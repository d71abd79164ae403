#include "gridgen/minimise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pelage {
namespace {

TEST(Minimise, finds_the_bottom_of_rosenbrocks_valley) {
  std::vector<double> x = {-1.2, 1};
  const Minimum m = minimise(
      [](const std::vector<double>& p, std::vector<double>& g) {
        const double a = 1 - p[0], b = p[1] - p[0] * p[0];
        g = {-2 * a - 400 * p[0] * b, 200 * b};
        return a * a + 100 * b * b;
      },
      x, {.most_iterations = 200, .tolerance = 1e-12});
  EXPECT_TRUE(m.converged);
  EXPECT_NEAR(x[0], 1, 1e-5);
  EXPECT_NEAR(x[1], 1, 1e-5);
}

TEST(Minimise, never_steps_over_a_wall) {
  std::vector<double> x = {1};
  bool over = false;
  minimise(
      [&](const std::vector<double>& p, std::vector<double>& g) {
        if (!(p[0] > 0)) return std::numeric_limits<double>::infinity();
        over = over || p[0] <= 0;
        g = {1 - 1e-4 / p[0]};
        return p[0] - 1e-4 * std::log(p[0]) + 1;
      },
      x, {.tolerance = 1e-14});
  EXPECT_FALSE(over);
  EXPECT_NEAR(x[0], 1e-4, 1e-7);
}

}  // namespace
}  // namespace pelage
