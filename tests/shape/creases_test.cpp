#include "shape/creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sample_meshes.h"
#include "shape/generators.h"
#include "shape/hierarchy.h"
#include "shape/vectors.h"
#include "support/random_creases.h"

namespace pelage {
namespace {

Topology topology_of(const TriangleMesh& mesh) { return make_topology(mesh.points.size(), mesh.triangles); }

Topology creased_cube(TriangleMesh& mesh) {
  mesh = builtin_shape("builtin:cube?n=150");
  Topology t = topology_of(mesh);
  t.creases = creases_above(40, t, mesh.points);
  return t;
}

TEST(Creases, ThoseOfACubeAreItsEdges) {
  TriangleMesh mesh;
  const Topology t = creased_cube(mesh);
  double extent = 0;
  for (const Point& p : mesh.points) extent = std::max(extent, p[0]);
  const auto sides = [&](const Point& p) {  // on which it lies
    return std::ranges::count_if(p, [&](double x) { return std::abs(x) > 0.999 * extent; });
  };
  for (std::size_t h = 0; h < t.twin.size(); ++h) {
    const Point &a = mesh.points[t.origin(static_cast<Index>(h))], &b = mesh.points[t.target(static_cast<Index>(h))];
    Point middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (a[k] + b[k]) / 2;
    EXPECT_EQ(t.creases.edge[t.edge[h]] != 0, sides(middle) == 2);
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_EQ(t.creases.corner[v] != 0, sides(mesh.points[v]) == 3);
}

TEST(Creases, NoneWhereNothingBends) {
  const TriangleMesh sheet = test::sheet(4), cube = builtin_shape("builtin:cube?n=150");
  EXPECT_FALSE(creases_above(40, topology_of(sheet), sheet.points).any());
  EXPECT_FALSE(creases_above(95, topology_of(cube), cube.points).any());
}

/// Flat faces stay flat and edges straight: the limit surface of a cube with its creases is the cube.
TEST(Creases, ALimitSurfaceWithoutRounding) {
  TriangleMesh mesh;
  Hierarchy levels(creased_cube(mesh), loop_refine);
  levels.refine();
  levels.refine();
  const std::vector<Point> control = levels.refined(mesh.points, 0, 2);
  const Topology& fine = levels.topology(2);
  double extent = 0;
  for (const Point& p : mesh.points) extent = std::max(extent, p[0]);
  for (const Point& p : loop_limits(fine, control))
    EXPECT_NEAR(std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}), extent, 1e-12);
  const CornerNormals normals(fine, control);
  for (std::size_t f = 0; f < fine.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b, c] = fine.triangles[f];
      const Point face = unit(cross(difference(control[b], control[a]), difference(control[c], control[a])));
      EXPECT_LT(length(difference(normals.at(f, k), face)), 1e-12);
    }
}

TEST(Creases, WeightsSumToOneAndLimitsStayWhenRefined) {
  for (const TriangleMesh& mesh : {test::tetrahedron(), test::sheet(4), builtin_shape("builtin:animal?n=500")}) {
    Topology t = topology_of(mesh);
    t.creases = testing::random_creases(t, 0.15);
    Hierarchy levels(t, loop_refine);
    levels.refine();
    const std::vector<Point> fine = levels.refined(mesh.points, 0, 1);
    const std::vector<double> ones = levels.refined(std::vector<double>(mesh.points.size(), 1.0), 0, 1);
    for (const double one : ones) EXPECT_NEAR(one, 1, 1e-14);
    const LimitMasks a = loop_limit_masks(t), b = loop_limit_masks(levels.topology(1));
    const auto limit = combine(a.position, mesh.points), after = combine(b.position, fine);
    for (std::size_t v = 0; v < limit.size(); ++v) EXPECT_LT(length(difference(limit[v], after[v])), 1e-13) << v;
    const std::vector<double> one(mesh.points.size(), 1.0);
    for (const double x : combine(a.position, one)) EXPECT_NEAR(x, 1, 1e-13);
    for (auto member : {&LimitMasks::tangent1, &LimitMasks::tangent2}) {
      for (const double x : combine(a.*member, one)) EXPECT_NEAR(x, 0, 1e-12);
      const auto coarse_tangent = combine(a.*member, mesh.points), fine_tangent = combine(b.*member, fine);
      for (std::size_t v = 0; v < limit.size(); ++v) {
        if (t.creases.corner[v]) continue;
        const double lengths = length(coarse_tangent[v]) * length(fine_tangent[v]);
        EXPECT_NEAR(dot(coarse_tangent[v], fine_tangent[v]), lengths, 1e-11 * (1 + lengths)) << v;
      }
    }
  }
}

/// Sectors come one after the other around a vertex and share their ends.
TEST(Creases, SectorsPartTheRing) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  Topology t = topology_of(mesh);
  t.creases = testing::random_creases(t, 0.4);
  VertexRing around;
  for (Index v = 0; v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    if (around.sharp.size() < 2) continue;
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < around.sharp.size(); ++i) {
      const std::vector<Index> part = sector(around, i);
      EXPECT_EQ(part.back(), sector(around, (i + 1) % around.sharp.size()).front());
      triangles += part.size() - 1;
    }
    EXPECT_EQ(triangles, around.ring.size());
  }
}

}  // namespace
}  // namespace pelage
