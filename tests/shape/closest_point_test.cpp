#include "shape/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

TEST(ClosestPoint, OfATriangle) {
  const Point a = {0, 0, 0}, b = {4, 0, 0}, c = {0, 3, 0};
  EXPECT_DOUBLE_EQ(square_distance({1, 1, 2}, a, b, c), 4);           // above the inside
  EXPECT_DOUBLE_EQ(square_distance({2, -2, 0}, a, b, c), 4);          // beside an edge
  EXPECT_DOUBLE_EQ(square_distance({-3, -4, 0}, a, b, c), 25);        // beside a corner
  EXPECT_DOUBLE_EQ(square_distance({2, 5, 0}, a, b, {8, 0, 0}), 25);  // degenerate: a segment
}

TEST(ClosestPoint, TheTreeFindsWhatTryingAllFinds) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=500");
  const DistanceTree tree(mesh);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Point p = {3 * uniform(1, i) - 1.5, 3 * uniform(2, i) - 1.5, 3 * uniform(3, i) - 1.5};
    double best = 1e300;
    for (const Triangle& t : mesh.triangles)
      best = std::min(best, square_distance(p, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    EXPECT_DOUBLE_EQ(tree.distance(p), std::sqrt(best));
  }
  EXPECT_TRUE(std::isinf(DistanceTree({}).distance({0, 0, 0})));
}

}  // namespace
}  // namespace pelage
