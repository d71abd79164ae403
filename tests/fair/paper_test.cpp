#include <gtest/gtest.h>

#include "discretise/sampling.h"
#include "fair/compare.h"
#include "fair/noisy.h"
#include "pelage/error.h"
#include "pelage/fair.h"

namespace pelage {
namespace {

/// The unit sphere after a conformal map onto itself: triangles of the same shapes, nine times as large at one pole as
/// at the other.
TriangleMesh uneven_sphere() {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  for (Point& p : mesh.points) {
    const double up = 9 * (1 + p[2]), down = 1 - p[2];  // stereographic, three times as large, and back
    p = {6 * p[0] / (up + down), 6 * p[1] / (up + down), (up - down) / (up + down)};
  }
  return mesh;
}

/// Mean square of the edges around each vertex over that of all.
std::vector<double> local_sizes(const TriangleMesh& mesh) {
  std::vector<double> sum(mesh.points.size(), 0), count = sum;
  double all = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];  // every edge comes twice, once from each end
      const double square = (vector3(mesh.points[a]) - vector3(mesh.points[b])).squaredNorm();
      sum[a] += square, count[a] += 1, all += square;
    }
  const double mean = all / static_cast<double>(3 * mesh.triangles.size());
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= count[v] * mean;
  return sum;
}

std::vector<Point> after_a_step(const TriangleMesh& mesh, const FairOptions& options) {
  Fairing fairing(mesh, options);
  fairing.step();
  return fairing.state().points;
}

FairOptions printed(double mu) {
  return {.method = "paper", .steps = 1, .sigma = 1, .angle = 10, .motion = "full", .mu = mu};
}

/// Eq. (21) with the test function 1: what a^-mu weighs stays where it is.
TEST(Paper, KeepsTheCentreThatMuWeighs) {
  const TriangleMesh mesh = testing::with_noise(uneven_sphere(), 0.1);
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  const Discretisation space = loop_discretisation(topology);
  const std::vector<double> size = local_sizes(mesh);
  const Vector a = quadrature_values(space) * Eigen::Map<const Vector>(size.data(), std::ssize(size));
  const auto shift = [&](double weight, double mu) {
    std::vector<double> factor;
    for (const double value : a) factor.push_back(std::pow(value, -weight));
    const SparseMatrix mass = Assembler(space).mass(mesh.points, factor);
    const std::vector<Point> points = after_a_step(mesh, printed(mu));
    Vector way(std::ssize(points));
    for (std::size_t v = 0; v < points.size(); ++v)
      way[static_cast<Eigen::Index>(v)] = points[v][2] - mesh.points[v][2];
    return std::abs((mass * way).sum());
  };
  for (const double mu : {0.0, 0.5, 1.0}) {
    EXPECT_LT(shift(mu, mu), 1e-6) << mu;
    EXPECT_GT(shift(mu == 0 ? 1 : 0, mu), 1e-4) << mu;
  }
}

/// a(x) makes a step take as much noise off small triangles as off large ones, in the tensor or in the step.
TEST(Paper, TakesAsMuchOffSmallTrianglesAsOffLargeOnes) {
  const TriangleMesh clean = uneven_sphere();
  const std::vector<double> size = local_sizes(clean);
  TriangleMesh noisy = clean;
  const double h = testing::mean_edge(clean);
  for (std::size_t v = 0; v < clean.points.size(); ++v)
    for (double& x : noisy.points[v]) x *= 1 + 1e-3 * h * std::sqrt(size[v]) * testing::gaussian(1, v);
  for (const double mu : {0.0, 1.0}) {
    FairOptions options = printed(mu);
    options.angle = 180;  // nothing is an edge
    const std::vector<Point> a = after_a_step(noisy, options), b = after_a_step(clean, options);
    double before[2] = {0, 0}, after[2] = {0, 0};
    for (std::size_t v = 0; v < clean.points.size(); ++v) {
      const std::size_t side = clean.points[v][2] > 0;
      if (std::abs(clean.points[v][2]) < 0.5) continue;
      before[side] += (vector3(noisy.points[v]) - vector3(clean.points[v])).squaredNorm();
      after[side] += (vector3(a[v]) - vector3(b[v])).squaredNorm();
    }
    const double left[2] = {std::sqrt(after[0] / before[0]), std::sqrt(after[1] / before[1])};
    EXPECT_LT(left[0], 0.8) << mu;
    EXPECT_NEAR(left[0] / left[1], 1, 0.2) << mu;
  }
}

TEST(Paper, ByDefaultKeepsEdgesAndFoldsNothing) {
  const TriangleMesh truth = builtin_shape("builtin:cube?n=3000"), noisy = testing::with_noise(truth, 0.3);
  const auto errors = [&](const FairOptions& options) { return *compare(fair(noisy, options).mesh, truth).normals; };
  const NormalErrors e = errors({.method = "paper"});
  const NormalErrors full = errors({.method = "paper", .motion = "full"});
  const NormalErrors blurred = errors({.method = "paper", .sigma = 1, .angle = 11.5});
  EXPECT_LT(e.mean, 4.5);
  EXPECT_EQ(e.flipped, 0U);
  EXPECT_LT(e.mean, full.mean);
  EXPECT_LT(e.sharp, blurred.sharp);
}

TEST(Paper, KnowsTwoMotions) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  EXPECT_THROW(fair(mesh, {.method = "paper", .motion = "tangential"}), Error);
}

}  // namespace
}  // namespace pelage
