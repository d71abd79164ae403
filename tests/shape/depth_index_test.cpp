#include "shape/depth_index.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_meshes.h"
#include "shape/generators.h"

namespace pelage {
namespace {

TEST(DepthIndex, ASphereHidesWhatIsBehindIt) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  const DepthIndex index(mesh.triangles, mesh.points);
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j) {
      const double x = i / 10.01, y = j / 10.01, r = std::hypot(x, y);
      if (std::abs(r - 1) < 0.01) continue;
      EXPECT_EQ(index.hides({x, y, -0.01}, 0), r < 1) << x << " " << y;
      EXPECT_FALSE(index.hides({x, y, 1.01}, 0));
    }
}

TEST(DepthIndex, WhatLiesNearerThanTheGapHidesNothing) {
  const TriangleMesh cube = test::cube();
  const DepthIndex index(cube.triangles, cube.points);
  EXPECT_TRUE(index.hides({0.3, 0.4, 0.8}, 0.1));
  EXPECT_FALSE(index.hides({0.3, 0.4, 0.95}, 0.1));
  EXPECT_FALSE(index.hides({1.5, 0.4, 0.2}, 0.1));
}

/// The grid against all triangles in turn.
TEST(DepthIndex, FindsWhatAPlainSearchFinds) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=2000");
  const DepthIndex index(mesh.triangles, mesh.points);
  std::size_t hidden = 0;
  for (std::size_t v = 0; v < mesh.points.size(); v += 40) {
    Point place = mesh.points[v];
    place[0] += 0.003;
    place[1] -= 0.002;
    bool plain = false;
    for (const Triangle& t : mesh.triangles) {
      const std::vector<Triangle> one{t};
      plain = plain || DepthIndex(one, mesh.points).hides(place, 0.01);
    }
    hidden += plain;
    EXPECT_EQ(index.hides(place, 0.01), plain);
  }
  EXPECT_GT(hidden, 10U);
}

}  // namespace
}  // namespace pelage
