#include "discretise/loop_patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "shape/loop_subdivision.h"

namespace pelage {
namespace {

/// A triangle (0, 1, 2) whose corners have the given types, with just the triangles that touch a corner.
struct Neighbourhood {
  Topology topology;
  std::vector<Index> points;
  Index patch_class = 0;
};

/// Closed fans of chosen valence around the corners of a triangle, as a planar drawing needs no geometry.
Neighbourhood closed_neighbourhood(LoopPatches& patches, std::array<Index, 3> valence) {
  std::vector<Triangle> t = {{0, 1, 2}};
  Index next = 3;
  std::array<Index, 3> across{};  // across edge i, i+1
  for (auto& a : across) a = next++;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = static_cast<Index>(i), b = static_cast<Index>((i + 1) % 3);
    t.push_back({b, a, across[i]});
  }
  for (std::size_t i = 0; i < 3; ++i) {  // the fan of corner i from `across previous edge` to `across next edge`
    Index from = across[(i + 2) % 3];
    for (Index k = 0; k < valence[i] - 5; ++k) {
      t.push_back({static_cast<Index>(i), from, next});
      from = next++;
    }
    t.push_back({static_cast<Index>(i), from, across[i]});
  }
  Neighbourhood n;
  n.topology = make_topology(static_cast<std::size_t>(next), t);
  n.patch_class = patches.classify(n.topology, 0, n.points);
  return n;
}

/// A triangulated fan of `triangles` faces around a boundary vertex 0; the patch is face `position`, extended by a row
/// of further triangles so that the other corners are inside or on the boundary as they come.
Neighbourhood boundary_neighbourhood(LoopPatches& patches, Index triangles, Index position) {
  std::vector<Triangle> t;
  for (Index k = 0; k < triangles; ++k) t.push_back({0, 1 + k, 2 + k});
  Index next = triangles + 2;
  for (Index k = 0; k < triangles; ++k) {  // a second row
    t.push_back({1 + k, next + k, 2 + k});
    if (k > 0) t.push_back({1 + k, next + k - 1, next + k});
  }
  Neighbourhood n;
  n.topology = make_topology(static_cast<std::size_t>(next + triangles), t);
  n.patch_class = patches.classify(n.topology, position, n.points);
  return n;
}

std::vector<Neighbourhood> all_cases(LoopPatches& patches) {
  std::vector<Neighbourhood> cases;
  for (Index n = 4; n <= 12; ++n) cases.push_back(closed_neighbourhood(patches, {n, 6, 6}));
  for (auto v : {std::array<Index, 3>{5, 7, 6}, {6, 4, 9}, {12, 5, 4}, {7, 8, 5}, {4, 5, 7}, {5, 5, 5}})
    cases.push_back(closed_neighbourhood(patches, v));
  for (Index k = 1; k <= 6; ++k)
    for (Index p = 0; p < k; ++p) cases.push_back(boundary_neighbourhood(patches, k, p));
  Neighbourhood tetrahedron;  // valence 3
  tetrahedron.topology = make_topology(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  tetrahedron.patch_class = patches.classify(tetrahedron.topology, 0, tetrahedron.points);
  cases.push_back(tetrahedron);
  Neighbourhood cap;  // one valence-3 corner in a larger mesh
  cap.topology = make_topology(
      7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 4, 2}, {2, 5, 3}, {3, 6, 1}, {1, 6, 4}, {2, 4, 5}, {3, 5, 6}});
  cap.patch_class = patches.classify(cap.topology, 0, cap.points);
  cases.push_back(cap);
  return cases;
}

std::vector<std::array<double, 2>> sample_places() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::array<double, 2>> places = {{0.5, 0.25}, {0.01, 0.01}, {1.0 / 3, 1.0 / 3}};
  while (places.size() < 12) {
    const double v = unit(random), w = unit(random);
    if (v + w < 1) places.push_back({v, w});
  }
  return places;
}

TEST(LoopPatch, BasisFunctionsSumToOneAndDerivativesToZero) {
  LoopPatches patches;
  for (const Neighbourhood& n : all_cases(patches))
    for (auto [v, w] : sample_places()) {
      const PatchJet jet = patches.evaluate(n.patch_class, v, w);
      EXPECT_NEAR(jet.row(0).sum(), 1, 1e-12);
      for (int d = 1; d < 6; ++d) EXPECT_NEAR(jet.row(d).sum() / jet.row(d).cwiseAbs().maxCoeff(), 0, 1e-11);
    }
}

TEST(LoopPatch, DerivativesMatchDifferences) {
  LoopPatches patches;
  for (const Neighbourhood& n : all_cases(patches))
    for (auto [v, w] : {std::array{0.3, 0.25}, {0.15, 0.62}, {0.05, 0.03}, {0.4, 0.45}}) {
      const double h = 1e-4;
      auto at = [&](double dv, double dw) { return patches.evaluate(n.patch_class, v + dv * h, w + dw * h); };
      const PatchJet jet = at(0, 0);
      // Fourth-order central differences of the values (first) and of the first derivatives (second).
      auto difference = [&](int row, double dv, double dw) -> Eigen::RowVectorXd {
        return (8 * (at(dv, dw).row(row) - at(-dv, -dw).row(row)) -
                (at(2 * dv, 2 * dw).row(row) - at(-2 * dv, -2 * dw).row(row))) /
               (12 * h);
      };
      EXPECT_LT((difference(0, 1, 0) - jet.row(1)).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LT((difference(0, 0, 1) - jet.row(2)).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LT((difference(1, 1, 0) - jet.row(3)).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LT((difference(1, 0, 1) - jet.row(4)).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LT((difference(2, 0, 1) - jet.row(5)).cwiseAbs().maxCoeff(), 1e-6);
    }
}

/// The refinement equation: the patch over a child of the subdivided mesh is the same surface.
TEST(LoopPatch, SubdividedMeshHasTheSameLimitSurface) {
  LoopPatches patches;
  for (const Neighbourhood& n : all_cases(patches)) {
    const Refinement fine = loop_refine(n.topology);
    const Topology fine_topology = make_topology(fine.stencils.rows(), fine.triangles);
    std::vector<double> control(static_cast<std::size_t>(n.topology.vertex_count));
    std::mt19937 random(3);
    for (double& c : control) c = std::uniform_real_distribution<double>(-1, 1)(random);
    const std::vector<double> refined = combine(fine.stencils, control);
    auto value = [&](const Topology& t, Index face, double v, double w, const std::vector<double>& values) {
      std::vector<Index> points;
      const Index c = patches.classify(t, face, points);
      const PatchJet jet = patches.evaluate(c, v, w);
      double sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        sum += jet(0, static_cast<Eigen::Index>(i)) * values[static_cast<std::size_t>(points[i])];
      return sum;
    };
    const double v = 0.21, w = 0.34;
    EXPECT_NEAR(value(fine_topology, 0, v, w, refined), value(n.topology, 0, v / 2, w / 2, control), 1e-13);
    EXPECT_NEAR(value(fine_topology, 1, v, w, refined), value(n.topology, 0, (1 + v) / 2, w / 2, control), 1e-13);
    EXPECT_NEAR(value(fine_topology, 2, v, w, refined), value(n.topology, 0, v / 2, (1 + w) / 2, control), 1e-13);
    EXPECT_NEAR(value(fine_topology, 3, v, w, refined), value(n.topology, 0, (1 - v) / 2, (1 - w) / 2, control), 1e-13);
  }
}

TEST(LoopPatch, LimitMasksAgreeWithEvaluation) {
  LoopPatches patches;
  for (const Neighbourhood& n : all_cases(patches)) {
    const LimitMasks masks = loop_limit_masks(n.topology);
    std::vector<Point> control(static_cast<std::size_t>(n.topology.vertex_count));
    std::mt19937 random(5);
    for (Point& p : control)
      for (double& x : p) x = std::uniform_real_distribution<double>(-1, 1)(random);
    const auto limit = combine(masks.position, control), t1 = combine(masks.tangent1, control),
               t2 = combine(masks.tangent2, control);
    auto evaluate = [&](double v, double w) {
      const PatchJet jet = patches.evaluate(n.patch_class, v, w);
      Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();
      for (std::size_t i = 0; i < n.points.size(); ++i)
        rows += jet.topRows(3).col(static_cast<Eigen::Index>(i)) *
                Eigen::RowVector3d(control[static_cast<std::size_t>(n.points[i])].data());
      return rows;
    };
    const Eigen::Matrix3d corner = evaluate(0, 0);
    EXPECT_LT((corner.row(0) - Eigen::RowVector3d(limit[0].data())).norm(), 1e-9);
    // The normal near the corner converges to that of the masks as a power of a ratio of eigenvalues (0.9 per level at
    // the worst here). From six boundary triangles on, Loop's surface has no tangent plane there. Below the regular
    // valence the patch shrinks faster than its parameters, and round-off forbids to go as near.
    std::vector<Index> ring;
    n.topology.one_ring(0, ring);
    const bool boundary = n.topology.on_boundary(0);
    if (boundary && ring.size() > 5) continue;
    const double distance = ring.size() < (boundary ? 4U : 6U) ? 0x1p-14 : 0x1p-38;
    const Eigen::Matrix3d near = evaluate(distance, distance);
    const Eigen::RowVector3d normal = near.row(1).cross(near.row(2)).normalized();
    const Eigen::RowVector3d expected =
        Eigen::RowVector3d(t1[0].data()).cross(Eigen::RowVector3d(t2[0].data())).normalized();
    EXPECT_LT((normal - expected).norm(), 1e-2) << "valence " << ring.size() << ", boundary " << boundary;
  }
}

}  // namespace
}  // namespace pelage
