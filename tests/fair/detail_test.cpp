#include "fair/detail.h"

#include <gtest/gtest.h>

#include "fair/noisy.h"

namespace pelage {
namespace {

double distance(const std::vector<Point>& a, const std::vector<Point>& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += (vector3(a[v]) - vector3(b[v])).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

struct Restored {
  TriangleMesh truth = builtin_shape("builtin:sphere?n=2562");
  Topology topology = make_topology(truth.points.size(), truth.triangles);
  std::vector<char> fixed = std::vector<char>(truth.points.size(), 0);

  std::vector<Point> operator()(const std::vector<Point>& from, std::vector<Point> points) const {
    give_back_detail(topology, fixed, from, points);
    return points;
  }
};

TEST(Detail, OfNoiseNothingIsGivenBack) {
  const Restored restored;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Point> noisy = testing::with_noise(restored.truth, 0.2, seed).points;
    EXPECT_EQ(restored(noisy, restored.truth.points), restored.truth.points) << seed;
  }
}

TEST(Detail, OfImpulsesOnSomeVerticesNothingIsGivenBack) {
  const Restored restored;
  std::vector<Point> noisy = testing::with_noise(restored.truth, 0.05).points;
  const std::vector<Point> loud = testing::with_noise(restored.truth, 0.5, 2).points;
  for (std::size_t v = 0; v < noisy.size(); ++v)
    if (uniform(3, v) < 0.2) noisy[v] = loud[v];
  EXPECT_EQ(restored(noisy, restored.truth.points), restored.truth.points);
}

/// A filter that takes off all of a noise of 0.05 and bumps as high as half an edge on a quarter of the sphere.
TEST(Detail, BumpsThatTheFilterTookOffComeBack) {
  const Restored restored;
  TriangleMesh bumpy = restored.truth;
  const double h = testing::mean_edge(bumpy);
  for (std::size_t v = 0; v < bumpy.points.size(); ++v)
    if (bumpy.points[v][2] > 0.5)
      for (double& x : bumpy.points[v]) x *= 1 + (v % 2 ? 0.5 : -0.5) * h;
  const std::vector<Point> noisy = testing::with_noise(bumpy, 0.05).points;
  const double before = distance(restored.truth.points, bumpy.points);
  EXPECT_LT(distance(restored(noisy, restored.truth.points), bumpy.points), 0.15 * before);
}

TEST(Detail, FixedVerticesNeitherMoveNorCount) {
  Restored restored;
  restored.fixed.assign(restored.fixed.size(), 1);
  const std::vector<Point> noisy = testing::with_noise(restored.truth, 0.2).points;
  EXPECT_EQ(restored(noisy, restored.truth.points), restored.truth.points);
}

}  // namespace
}  // namespace pelage
