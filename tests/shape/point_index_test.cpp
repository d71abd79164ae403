#include "shape/point_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"

namespace pelage {
namespace {

TEST(PointIndex, FindsWhatTryingAllFinds) {
  std::vector<Point> points;
  for (std::uint64_t i = 0; i < 400; ++i) points.push_back({uniform(1, i), uniform(2, i), uniform(3, i)});
  points.push_back({1e30, -1e30, 0});  // so far away that its box has no number
  const PointIndex index(points, 0.1);
  for (std::uint64_t q = 0; q < 50; ++q) {
    const Point from = {2 * uniform(4, q) - 0.5, uniform(5, q), uniform(6, q)};
    const double radius = 0.3 * uniform(7, q);
    std::vector<std::int32_t> found, all;
    index.for_each_within(from, radius, [&](std::int32_t i, double) { found.push_back(i); });
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double dx = points[i][0] - from[0], dy = points[i][1] - from[1], dz = points[i][2] - from[2];
      if (dx * dx + dy * dy + dz * dz <= radius * radius) all.push_back(static_cast<std::int32_t>(i));
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, all);
  }
}

// Boxes so far out have no numbers of their own.
TEST(PointIndex, FindsWhatLiesFarOut) {
  const std::vector<Point> points = {{1e300, 0, 0}, {-1e300, 0, 0}, {0, 0, 0}};
  const PointIndex index(points, 1e-3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::int32_t> found;
    index.for_each_within(points[i], 1e-3, [&](std::int32_t k, double) { found.push_back(k); });
    EXPECT_EQ(found, std::vector<std::int32_t>{static_cast<std::int32_t>(i)});
  }
}

}  // namespace
}  // namespace pelage
