#include "gridgen/transfinite.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pelage {
namespace {

/// What is linear along either axis at least is reproduced from the border, and is not along both.
TEST(Transfinite, IsExactWhereMapsAreLinearAlongOneOfTheAxes) {
  const auto map = [](double u, double v) {
    return Point{std::exp(u) * (1 + v) + v * v * (2 - u), std::sin(3 * u) * v + std::cos(v) * (1 + u), u * v};
  };
  const Sheet sheet{{7, 5}, false};
  Border border;
  for (int i = 0; i < 7; ++i) {
    border.side[0].push_back(map(i / 6.0, 0));
    border.side[2].push_back(map(i / 6.0, 1));
  }
  for (int j = 0; j < 5; ++j) {
    border.side[1].push_back(map(1, j / 4.0));
    border.side[3].push_back(map(0, j / 4.0));
  }
  const std::vector<Point> nodes = transfinite(sheet, border);
  for (std::int32_t j = 0; j < 5; ++j)
    for (std::int32_t i = 0; i < 7; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(nodes[sheet.node(i, j)][k], map(i / 6.0, j / 4.0)[k], 1e-14) << i << ", " << j;
}

}  // namespace
}  // namespace pelage
