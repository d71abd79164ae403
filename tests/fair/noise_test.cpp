#include "fair/noise.h"

#include <gtest/gtest.h>

#include "fair/noisy.h"

namespace pelage {
namespace {

/// In mean edges of the noisy mesh.
double estimated(const TriangleMesh& mesh) {
  return estimate_noise(make_topology(mesh.points.size(), mesh.triangles), mesh.points) / testing::mean_edge(mesh);
}

TEST(Noise, IsFoundOnSmoothAndOnEdgedShapes) {
  for (const char* shape : {"builtin:sphere?n=2562", "builtin:cube?n=3000", "builtin:torus?n=4000"})
    for (const double sigma : {0.05, 0.2}) {
      const TriangleMesh truth = builtin_shape(shape), noisy = testing::with_noise(truth, sigma);
      // The noise lengthens the edges.
      const double expected = sigma * testing::mean_edge(truth) / testing::mean_edge(noisy);
      EXPECT_NEAR(estimated(noisy) / expected, 1, 0.08) << shape << " " << sigma;
    }
}

/// Triangles that are large against the bends: two rings would find three times as much.
TEST(Noise, IsFoundOnACoarseShape) {
  for (const double sigma : {0.05, 0.1}) {
    const double found = estimated(testing::with_noise(builtin_shape("builtin:torus?n=200"), sigma));
    EXPECT_NEAR(found / sigma, 1, 0.35) << sigma;
  }
}

TEST(Noise, IsNearlyNoneWhereThereIsNone) {
  for (const char* shape : {"builtin:sphere?n=2562", "builtin:cube?n=3000"})
    EXPECT_LT(estimated(builtin_shape(shape)), 1e-3) << shape;
}

TEST(Noise, OfAMeshTooSmallToTellIsNone) {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(estimate_noise(make_topology(3, {{0, 1, 2}}), points), 0);
}

}  // namespace
}  // namespace pelage
