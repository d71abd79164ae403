#include "fair/whiteness.h"

#include <gtest/gtest.h>

#include "fair/noisy.h"
#include "pelage/fair.h"

namespace pelage {
namespace {

struct Measured {
  TriangleMesh truth;
  Topology topology = make_topology(truth.points.size(), truth.triangles);
  std::vector<char> fixed = std::vector<char>(truth.points.size(), 0);

  double operator()(const std::vector<Point>& from, const std::vector<Point>& points) const {
    return correlation_of_ways(topology, fixed, from, points);
  }
};

TEST(Whiteness, OfOneWayForAllIsOneAndOfNoiseZero) {
  const Measured correlation{builtin_shape("builtin:sphere?n=2562")};
  const std::vector<Point>& points = correlation.truth.points;
  std::vector<Point> larger = points;
  for (Point& p : larger)
    for (double& x : p) x *= 1.1;
  EXPECT_NEAR(correlation(larger, points), 1, 1e-3);  // but for the angle between normals and radii
  EXPECT_EQ(correlation(points, points), 0);
  for (const std::uint64_t seed : {1, 2, 3})  // three standard deviations of 7680 pairs
    EXPECT_NEAR(correlation(testing::with_noise(correlation.truth, 0.2, seed).points, points), 0, 0.035) << seed;
}

TEST(Whiteness, FixedVerticesDoNotCount) {
  Measured correlation{builtin_shape("builtin:sphere?n=642")};
  for (std::size_t v = 0; v < correlation.fixed.size(); ++v) correlation.fixed[v] = v % 2;
  const std::vector<Point>& points = correlation.truth.points;
  const std::vector<Point> all = testing::with_noise(correlation.truth, 0.2).points;
  std::vector<Point> free = all;
  for (std::size_t v = 1; v < free.size(); v += 2) free[v] = points[v];
  EXPECT_EQ(correlation(all, points), correlation(free, points));
}

/// Growths of the correlation, in those of noise alone, while the guided filter runs.
std::vector<double> growths(const TriangleMesh& truth, double noise, int steps, double tolerance) {
  const TriangleMesh noisy = testing::with_noise(truth, noise);
  const Measured correlation{truth};
  Fairing fairing(noisy, {.steps = steps});
  std::vector<double> growth;
  for (double before = correlation_of_noise(0); !fairing.done();) {
    fairing.step();
    const int step = fairing.report().steps;
    const double now = correlation(noisy.points, fairing.state().points);
    EXPECT_NEAR(now, correlation_of_noise(step), tolerance) << noise << ", step " << step;
    growth.push_back((now - before) / growth_of_noise(step));
    before = now;
  }
  return growth;
}

TEST(Whiteness, OfNoiseAloneFollowsTheFit) {
  for (const double noise : {0.1, 0.4}) growths(builtin_shape("builtin:sphere?n=2562"), noise, 12, 0.03);
  growths(builtin_shape("builtin:cube?n=3000"), 0.4, 12, 0.03);
}

TEST(Whiteness, ShapeThatGoesAlongLetsItGrowFaster) {
  const std::vector<double> noise = growths(builtin_shape("builtin:cube?n=3000"), 0.3, 6, 1);
  const std::vector<double> shape = growths(builtin_shape("builtin:animal?n=1000"), 0.2, 6, 1);
  EXPECT_LT(noise.back(), 1.35);
  EXPECT_GT(shape.back(), 1.6);
}

}  // namespace
}  // namespace pelage
