#include "discretise/cubic_triangle.h"

#include <gtest/gtest.h>

namespace pelage {
namespace {

struct Quadratic {
  double operator()(double v, double w) const { return 1 + 2 * v - 3 * w + 4 * v * v + 5 * v * w - 6 * w * w; }
  double dv(double v, double w) const { return 2 + 8 * v + 5 * w; }
  double dw(double v, double w) const { return -3 + 5 * v - 12 * w; }
};

TEST(CubicTriangle, ReproducesQuadratics) {
  const Quadratic f;
  const std::array<double, 3> corner = {f(0, 0), f(1, 0), f(0, 1)};
  const std::array<std::array<double, 2>, 3> toward = {
      {{f.dv(0, 0), f.dw(0, 0)}, {f.dw(1, 0) - f.dv(1, 0), -f.dv(1, 0)}, {-f.dw(0, 1), f.dv(0, 1) - f.dw(0, 1)}}};
  for (double v = 0; v <= 1; v += 0.125)
    for (double w = 0; v + w <= 1; w += 0.125) EXPECT_NEAR(cubic_triangle(corner, toward, v, w), f(v, w), 1e-14);
}

}  // namespace
}  // namespace pelage
