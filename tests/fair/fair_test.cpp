#include "pelage/fair.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>

#include "base/parallel.h"
#include "fair/compare.h"
#include "fair/noisy.h"
#include "pelage/io.h"
#include "shape/vectors.h"
#include "support/reordered.h"

namespace pelage {
namespace {

using testing::with_noise;
using testing::with_noise_everywhere;

NormalErrors errors(const TriangleMesh& mesh, const TriangleMesh& truth) { return *compare(mesh, truth).normals; }

TEST(Fair, TakesTheNoiseOffACubeAndKeepsItsEdges) {
  const TriangleMesh truth = builtin_shape("builtin:cube?n=3000"), noisy = with_noise(truth, 0.2);
  const Faired result = fair(noisy);
  const NormalErrors e = errors(result.mesh, truth);
  EXPECT_GT(errors(noisy, truth).mean, 15);
  EXPECT_LT(e.mean, 1.5);
  EXPECT_LT(e.sharp, 4);
  EXPECT_EQ(e.flipped, 0U);
  EXPECT_NEAR(result.report.noise, 0.2, 0.02);
}

/// Root mean square and largest distance of the vertices on the edges of the cube [-a, a]^3 from these edges.
std::pair<double, double> crookedness(const TriangleMesh& mesh, const TriangleMesh& truth) {
  double a = 0, worst = 0, sum = 0;
  int count = 0;
  for (const Point& p : truth.points) a = std::max(a, p[0]);
  for (std::size_t v = 0; v < truth.points.size(); ++v) {
    std::vector<std::size_t> at_limit;
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(std::abs(truth.points[v][k]) - a) < 1e-9) at_limit.push_back(k);
    if (at_limit.size() != 2) continue;
    double square = 0;
    for (std::size_t k : at_limit) square += std::pow(mesh.points[v][k] - truth.points[v][k], 2);
    worst = std::max(worst, std::sqrt(square));
    sum += square;
    ++count;
  }
  return {std::sqrt(sum / count), worst};
}

/// Coordinates of millions leave the result as exact as they are themselves.
TEST(Fair, DoesNotDependOnThePlace) {
  const Point utm = {431250, 5412875, 310};
  TriangleMesh noisy = with_noise(builtin_shape("builtin:sphere?n=642"), 0.2);
  for (Point& p : noisy.points)
    for (double& x : p) x = std::round(x * 0x1p20) / 0x1p20;  // so that moving it rounds nothing
  const TriangleMesh moved = testing::placed(noisy, 1, utm);
  for (const std::string& method : fair_methods()) {
    SCOPED_TRACE(method);
    const TriangleMesh here = fair(noisy, {.method = method, .steps = 3}).mesh;
    const TriangleMesh there = fair(moved, {.method = method, .steps = 3}).mesh;
    double most = 0;
    for (std::size_t v = 0; v < here.points.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, std::abs(there.points[v][k] - utm[k] - here.points[v][k]));
    EXPECT_LT(most, 1e-7);
  }
}

TEST(Fair, EdgesOfACubeAreStraight) {
  const TriangleMesh truth = builtin_shape("builtin:cube?n=3000");
  const TriangleMesh clean = fair(with_noise(truth, 0.1)).mesh;
  const auto [typical, worst] = crookedness(clean, truth);
  EXPECT_LT(typical, 0.05 * testing::mean_edge(truth));
  EXPECT_LT(worst, 0.13 * testing::mean_edge(truth));
}

TEST(Fair, LeavesNoPatternOnASphere) {
  const TriangleMesh truth = builtin_shape("builtin:sphere?n=2562");
  const Faired result = fair(with_noise(truth, 0.2));
  const NormalErrors e = errors(result.mesh, truth);
  EXPECT_LT(e.mean, 1.5);
  EXPECT_LT(e.quantile95, 3);  // the same everywhere: no facets, no ridges
}

TEST(Fair, UnfoldsTrianglesThatNoiseTurnedOver) {
  const TriangleMesh truth = builtin_shape("builtin:sphere?n=2562"), noisy = with_noise_everywhere(truth, 0.3);
  ASSERT_GT(errors(noisy, truth).flipped, 0U);
  const Faired result = fair(noisy);
  EXPECT_EQ(errors(result.mesh, truth).flipped, 0U);
  EXPECT_EQ(result.report.folded, 0U);
}

TEST(Fair, TakesOffAsMuchNoiseAsItIsTold) {
  const Faired result = fair(with_noise(builtin_shape("builtin:animal?n=2000"), 0.1), {.noise = 0.1});
  EXPECT_LT(result.report.steps, 30);
  EXPECT_NEAR(result.report.moved / result.report.noise, 0.95, 0.01);  // not the whole of the last step
}

/// What shape does not forbid goes on beyond the first estimate: flat faces become flat, edges straight.
TEST(Fair, TakesLoudNoiseOffACube) {
  const TriangleMesh truth = builtin_shape("builtin:cube?n=3000");
  const NormalErrors e = errors(fair(with_noise(truth, 0.6)).mesh, truth);
  EXPECT_LT(e.mean, 4);
  EXPECT_EQ(e.flipped, 0U);
}

/// A sphere with three ridges, the common part of six large ones.
TEST(Fair, KeepsRidgesOfASphere) {
  TriangleMesh truth = builtin_shape("builtin:sphere?n=2562");
  for (Point& p : truth.points) {
    const double most = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    const double radius = std::sqrt(0.36 * most * most + 1.2025) - 0.6 * most;
    for (double& x : p) x *= radius;
  }
  const NormalErrors e = errors(fair(with_noise(truth, 0.3)).mesh, truth);
  EXPECT_LT(e.mean, 4);
  EXPECT_EQ(e.flipped, 0U);
}

class EveryMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, ::testing::ValuesIn(fair_methods()),
                         [](const auto& name) { return name.param; });

TEST_P(EveryMethod, ImprovesANoisyShapeAndKeepsItsVolume) {
  const TriangleMesh truth = builtin_shape("builtin:animal?n=2000"), noisy = with_noise(truth, 0.2);
  const Faired result = fair(noisy, {.method = GetParam()});
  EXPECT_LT(errors(result.mesh, truth).mean, 0.7 * errors(noisy, truth).mean);
  EXPECT_LT(compare(result.mesh, truth).distance, compare(noisy, truth).distance);
  EXPECT_NEAR(result.report.volume_after / result.report.volume_before, 1, 1e-6);
  for (const Point& p : result.mesh.points)
    for (double x : p) ASSERT_TRUE(std::isfinite(x));
}

TEST_P(EveryMethod, FollowsRotationAndScale) {
  const TriangleMesh noisy = with_noise(builtin_shape("builtin:cube?n=600"), 0.1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  TriangleMesh turned = noisy;
  for (Point& p : turned.points) {
    const Eigen::Vector3d q = 1000 * (turn * vector3(p));
    p = {q[0], q[1], q[2]};
  }
  const FairOptions options{.method = GetParam(), .steps = 3};
  const TriangleMesh a = fair(noisy, options).mesh, b = fair(turned, options).mesh;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    ASSERT_LT((1000 * (turn * vector3(a.points[v])) - vector3(b.points[v])).norm(), 1e-4) << v;
}

TEST_P(EveryMethod, LeavesBoundariesAlone) {
  const TriangleMesh truth = builtin_shape("builtin:plane?n=900"), noisy = with_noise(truth, 0.2);
  const TriangleMesh clean = fair(noisy, {.method = GetParam()}).mesh;
  const Topology topology = make_topology(truth.points.size(), truth.triangles);
  for (Index v = 0; v < topology.vertex_count; ++v)
    if (topology.on_boundary(v)) {
      EXPECT_EQ(clean.points[v], noisy.points[v]);
    }
  EXPECT_LT(errors(clean, truth).mean, errors(noisy, truth).mean);
}

TEST_P(EveryMethod, IsTheSameOnOneThreadAndOnTwo) {
  const TriangleMesh noisy = with_noise(builtin_shape("builtin:animal?n=1000"), 0.1);
  const FairOptions options{.method = GetParam(), .steps = 2};
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return fair(noisy, options).mesh.points;
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

TEST(Fair, ThePapersFlowKeepsEdgesThatTheIsotropicOneRounds) {
  const TriangleMesh truth = builtin_shape("builtin:cube?n=3000"), noisy = with_noise(truth, 0.2);
  const auto sharp = [&](const std::string& method) {
    return errors(fair(noisy, {.method = method}).mesh, truth).sharp;
  };
  EXPECT_LT(sharp("paper"), 0.8 * sharp("isotropic"));
  EXPECT_LT(sharp("guided"), 0.5 * sharp("paper"));
}

TEST(Fair, LeavesACleanMeshNearlyAsItIs) {
  const TriangleMesh clean = builtin_shape("builtin:sphere?n=2562");
  EXPECT_LT(compare(fair(clean).mesh, clean).distance, 1e-5);
}

/// Where triangles are large against the bends of the surface, the shape looks like noise.
TEST(Fair, DoesNotMakeCoarseCurvedShapesWorse) {
  for (const auto& [shape, sigma] :
       {std::pair{"builtin:animal?n=500", 0.1}, std::pair{"builtin:animal?n=1000", 0.1},
        std::pair{"builtin:animal?n=2000", 0.05}, std::pair{"builtin:torus?n=200", 0.03}}) {
    const TriangleMesh truth = builtin_shape(shape), noisy = with_noise(truth, sigma), clean = fair(noisy).mesh;
    EXPECT_LT(errors(clean, truth).mean, errors(noisy, truth).mean) << shape;
    EXPECT_LT(compare(clean, truth).distance, compare(noisy, truth).distance) << shape;
    EXPECT_EQ(errors(clean, truth).flipped, 0U) << shape;
  }
  for (const char* shape : {"builtin:torus?n=200", "builtin:knot?n=600"}) {
    const TriangleMesh truth = builtin_shape(shape);
    EXPECT_LT(compare(fair(truth).mesh, truth).distance, 1e-4) << shape;
  }
}

TEST(Fair, RefusesWhatItDoesNotKnow) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  EXPECT_THROW(fair(mesh, {.method = "gided"}), Error);
  EXPECT_THROW(fair(mesh, {.noise = -1}), Error);
  EXPECT_THROW(fair(mesh, {.method = "paper", .mu = 2}), Error);
  EXPECT_THROW(fair(mesh, {}, [](std::string_view, double) { return false; }), Error);
}

TEST(Fair, OfASingleTriangleIsThatTriangle) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(fair(mesh, {.steps = 2}).mesh.points, mesh.points);
}

/// Real scans and parts, which do not belong to the project. No measure becomes worse, and the published pair and a
/// part with sharp edges become as good as asked. Where triangles are folded over in the
/// truth itself, as 70 of the large head, unfolding them counts as flips.
TEST(Fair, NoisyMeshesWithTheirTruth) {
  const std::string folder = PELAGE_SHARED_MESHES;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared meshes";
  struct Case {
    const char *truth, *noisy;
    double mean = 90;
    std::size_t flips = 0;
  };
  for (const Case& c :
       {Case{"block_8771.obj", "block_8771_noisy04.obj", 4.0},
        Case{"fandisk_6475.off", "fandisk_6475_n0.1_s1.off", 1.5},
        Case{"fandisk_6475.off", "fandisk_6475_n0.3_s1.off", 2.8},
        Case{"fandisk_6475.off", "fandisk_6475_xyz0.2_s2.off", 2.5},
        Case{"fandisk_6475.off", "fandisk_6475_impulse0.5_s3.off", 0.8},
        Case{"bunny_29834.obj", "bunny_29834_n0.1_s1.obj"}, Case{"bunny_29834.obj", "bunny_29834_n0.3_s1.obj"},
        Case{"bunny_3301.obj", "bunny_3301_n0.1_s1.obj"}, Case{"bunny_3301.obj", "bunny_3301_n0.3_s1.obj"},
        Case{"sphere_642.obj", "sphere_642_n0.1_s1.obj"}, Case{"sphere_642.obj", "sphere_642_n0.3_s1.obj"},
        Case{"venus_711.off", "venus_711_n0.1_s1.off"}, Case{"venus_711.off", "venus_711_n0.3_s1.off"},
        Case{"venus_head_8268.off", "venus_head_8268_n0.1_s1.off", 90, 70},
        Case{"venus_head_8268.off", "venus_head_8268_n0.3_s1.off", 90, 80}}) {
    const std::string noisy_path = folder + (c.mean == 4.0 ? "/" : "/noisy/") + c.noisy;
    const TriangleMesh truth = read_shape(folder + "/" + c.truth).mesh, noisy = read_shape(noisy_path).mesh;
    const Faired faired = fair(noisy);
    const Comparison before = compare(noisy, truth), after = compare(faired.mesh, truth);
    EXPECT_LT(after.normals->mean, std::min(before.normals->mean, c.mean)) << c.noisy;
    EXPECT_LE(after.normals->sharp, before.normals->sharp) << c.noisy;
    EXPECT_LE(after.normals->flipped, c.flips) << c.noisy;
    EXPECT_LT(after.distance, before.distance) << c.noisy;
    const double volume = faired.report.volume_before;
    EXPECT_LE(std::abs(faired.report.volume_after - volume), 0.005 * volume) << c.noisy;
  }
}

/// Taubin 1995: the waves of a smooth sphere are far below the pass band 1 / 0.5 - 1 / 0.53, where the steps back undo
/// a little more than the steps forward have done, even before the volume is restored.
TEST(Fair, TaubinDoesNotShrinkWhatIsSmooth) {
  Fairing fairing(builtin_shape("builtin:sphere?n=642"), {.method = "taubin", .steps = 50});
  while (!fairing.done()) fairing.step();
  double sum = 0;
  for (const Point& p : fairing.state().points) sum += length(p);
  EXPECT_GT(sum / 642, 1);
  EXPECT_LT(sum / 642, 1.03);
}

}  // namespace
}  // namespace pelage
