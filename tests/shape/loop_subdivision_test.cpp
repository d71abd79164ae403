#include "shape/loop_subdivision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_meshes.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

Topology of(const TriangleMesh& mesh) { return make_topology(mesh.points.size(), mesh.triangles); }
Topology of(const Refinement& r) { return make_topology(r.stencils.rows(), r.triangles); }

double row_sum(const Stencils& s, std::size_t row) {
  double sum = 0;
  for (auto k = s.start[row]; k < s.start[row + 1]; ++k) sum += s.weight[k];
  return sum;
}

double largest_difference(const std::vector<Point>& a, const std::vector<Point>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) worst = std::max(worst, std::abs(a[i][d] - b[i][d]));
  return worst;
}

TEST(LoopSubdivision, WeightsSumToOneAndThoseOfTangentsToZero) {
  for (const TriangleMesh& mesh : {test::tetrahedron(), test::sheet(), builtin_shape("builtin:animal?n=500")}) {
    const Refinement fine = loop_refine(of(mesh));
    for (std::size_t r = 0; r < fine.stencils.rows(); ++r) EXPECT_NEAR(row_sum(fine.stencils, r), 1, 1e-14);
    const LimitMasks masks = loop_limit_masks(of(mesh));
    for (std::size_t r = 0; r < masks.position.rows(); ++r) {
      EXPECT_NEAR(row_sum(masks.position, r), 1, 1e-14);
      EXPECT_NEAR(row_sum(masks.tangent1, r), 0, 1e-13);
      EXPECT_NEAR(row_sum(masks.tangent2, r), 0, 1e-13);
    }
  }
}

TEST(LoopSubdivision, CommutesWithAffineMaps) {
  const TriangleMesh mesh = builtin_shape("builtin:animal?n=500");
  auto map = [](std::vector<Point> points) {
    for (Point& p : points) p = {2 * p[0] + p[1] - 3, p[1] - 0.5 * p[2], 0.1 * p[0] + 3 * p[2] + 1};
    return points;
  };
  const Refinement fine = loop_refine(of(mesh));
  EXPECT_LT(largest_difference(combine(fine.stencils, map(mesh.points)), map(combine(fine.stencils, mesh.points))),
            1e-13);
}

/// Loop's original weights: 3/16 at valence 3 and 1/16 at valence 6.
TEST(LoopSubdivision, KnownWeights) {
  EXPECT_NEAR(loop_beta(3), 3.0 / 16, 1e-15);
  EXPECT_NEAR(loop_beta(6), 1.0 / 16, 1e-15);
  EXPECT_NEAR(loop_beta(4), 31.0 / 256, 1e-15);
}

/// A vertex of a tetrahedron: 7/16 of itself and 3/16 of the others; an edge: 3/8 of its ends, 1/8 of the others.
TEST(LoopSubdivision, Tetrahedron) {
  const TriangleMesh mesh = test::tetrahedron();
  const Topology t = of(mesh);
  const std::vector<Point> fine = combine(loop_refine(t).stencils, mesh.points);
  // The corners sum to 0, so that the others sum to minus the vertex.
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(fine[v][d], (7.0 / 16 - 3.0 / 16) * mesh.points[v][d], 1e-15);
  for (Index h = 0; h < 12; ++h)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(fine[4 + t.edge[h]][d], 0.25 * (mesh.points[t.origin(h)][d] + mesh.points[t.target(h)][d]), 1e-15);
}

/// The boundary is a uniform cubic B-spline of the boundary points alone: x^2 has second differences 2, hence the limit
/// i^2 + 1/3 at point i, and the fine boundary points have the same limits.
TEST(LoopSubdivision, BoundaryIsACubicBSpline) {
  const TriangleMesh sheet = test::sheet(8);
  const Topology t = of(sheet);
  std::vector<double> f(sheet.points.size());
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = sheet.points[i][0] * sheet.points[i][0] + 100 * sheet.points[i][1];
  const std::vector<double> limit = combine(loop_limit_masks(t).position, f);
  const Refinement fine = loop_refine(t);
  const std::vector<double> fine_limit = combine(loop_limit_masks(of(fine)).position, combine(fine.stencils, f));
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Point& p = sheet.points[i];
    if (p[1] != 0 || p[0] == 0 || p[0] == 8) continue;
    EXPECT_NEAR(limit[i], p[0] * p[0] + 1.0 / 3, 1e-13);
    EXPECT_NEAR(fine_limit[i], limit[i], 1e-13);
  }
}

/// Refining does not move the limits, however often.
TEST(LoopSubdivision, LimitsStayWhenRefinedTwice) {
  for (const TriangleMesh& mesh : {test::tetrahedron(), test::sheet(3), builtin_shape("builtin:animal?n=500")}) {
    const Topology coarse = of(mesh);
    const Refinement once = loop_refine(coarse);
    const std::vector<Point> control1 = combine(once.stencils, mesh.points);
    const Refinement twice = loop_refine(of(once));
    const std::vector<Point> control2 = combine(twice.stencils, control1);
    const auto limit0 = combine(loop_limit_masks(coarse).position, mesh.points);
    const auto limit1 = combine(loop_limit_masks(of(once)).position, control1);
    const auto limit2 = combine(loop_limit_masks(of(twice)).position, control2);
    EXPECT_LT(largest_difference(limit0, limit1), 1e-14);  // of the first vertices, which keep their numbers
    EXPECT_LT(largest_difference(limit1, limit2), 1e-14);
  }
}

/// A tangent is a left eigenvector of the subdivision: the fine one is that of the coarse mesh times an eigenvalue. The
/// directions, not only the span, must stay.
TEST(LoopSubdivision, TangentsStayWhenRefined) {
  for (const TriangleMesh& mesh : {test::tetrahedron(), test::sheet(3), builtin_shape("builtin:animal?n=500")}) {
    const Topology coarse = of(mesh);
    const Refinement fine = loop_refine(coarse);
    const std::vector<Point> control = combine(fine.stencils, mesh.points);
    const LimitMasks a = loop_limit_masks(coarse), b = loop_limit_masks(of(fine));
    for (auto member : {&LimitMasks::tangent1, &LimitMasks::tangent2}) {
      const auto before = combine(a.*member, mesh.points), after = combine(b.*member, control);
      for (std::size_t v = 0; v < before.size(); ++v) {
        const auto [x, y, z] = before[v];
        const auto [u, v1, w] = after[v];
        const double dot = x * u + y * v1 + z * w, square = (x * x + y * y + z * z) * (u * u + v1 * v1 + w * w);
        EXPECT_NEAR(dot, std::sqrt(square), 1e-12 * (1 + dot)) << "vertex " << v;
      }
    }
  }
}

TEST(LoopSubdivision, FourTrianglesInThePlaceOfOne) {
  const TriangleMesh mesh = test::torus(5);
  const Topology coarse = of(mesh);
  const Refinement fine = loop_refine(coarse), flat = midpoint_refine(coarse);
  EXPECT_EQ(fine.triangles, flat.triangles);
  EXPECT_EQ(fine.triangles.size(), 4 * mesh.triangles.size());
  EXPECT_EQ(of(fine).edge_count, 4 * coarse.edge_count);
  const std::vector<Point> points = combine(flat.stencils, mesh.points);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(fine.triangles[4 * f + k][k], mesh.triangles[f][k]);
      const Index middle = fine.triangles[4 * f + k][(k + 1) % 3];
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_DOUBLE_EQ(points[middle][d],
                         (mesh.points[mesh.triangles[f][k]][d] + mesh.points[mesh.triangles[f][(k + 1) % 3]][d]) / 2);
    }
}

TEST(LoopSubdivision, NormalsPointOutward) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  const LimitMasks masks = loop_limit_masks(of(mesh));
  const auto position = combine(masks.position, mesh.points), a = combine(masks.tangent1, mesh.points),
             b = combine(masks.tangent2, mesh.points);
  for (std::size_t v = 0; v < position.size(); ++v)
    EXPECT_GT(position[v][0] * (a[v][1] * b[v][2] - a[v][2] * b[v][1]) +
                  position[v][1] * (a[v][2] * b[v][0] - a[v][0] * b[v][2]) +
                  position[v][2] * (a[v][0] * b[v][1] - a[v][1] * b[v][0]),
              0);
}

TEST(LoopSubdivision, LimitsAndNormalsAreThoseOfTheMasks) {
  for (const TriangleMesh& mesh : {test::sheet(), builtin_shape("builtin:animal?n=5000")}) {
    const Topology topology = of(mesh);
    const LimitMasks masks = loop_limit_masks(topology);
    EXPECT_EQ(loop_limits(topology, mesh.points), combine(masks.position, mesh.points));
    std::vector<double> x;
    for (const Point& p : mesh.points) x.push_back(p[0]);
    EXPECT_EQ(loop_limits(topology, x), combine(masks.position, x));
    const auto a = combine(masks.tangent1, mesh.points), b = combine(masks.tangent2, mesh.points),
               normals = loop_limit_normals(topology, mesh.points);
    for (std::size_t v = 0; v < normals.size(); ++v)
      EXPECT_NEAR(length(difference(normals[v], unit(cross(a[v], b[v])))), 0, 1e-15);
  }
}

}  // namespace
}  // namespace pelage
