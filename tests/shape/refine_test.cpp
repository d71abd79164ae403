#include "shape/refine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape/generators.h"

namespace pelage {
namespace {

TEST(PrevailingEdge, IsTheEdgeOfAnEvenMesh) {
  // Two halves of unit squares: the diagonal.
  EXPECT_NEAR(prevailing_edge({{0, 1, 2}, {0, 2, 3}}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), std::sqrt(2.0),
              1e-15);
}

/// One large triangle of two percent of the area does not decide.
TEST(PrevailingEdge, IgnoresASmallPartOfTheArea) {
  const TriangleMesh plane = builtin_shape("builtin:plane?n=2500");
  std::vector<Point> points = plane.points;
  std::vector<Triangle> triangles = plane.triangles;
  const double before = prevailing_edge(triangles, points);
  const auto n = static_cast<Index>(points.size());
  points.insert(points.end(), {{0, 0, 1}, {0.2, 0, 1}, {0, 0.2, 1}});
  triangles.push_back({n, n + 1, n + 2});
  EXPECT_NEAR(prevailing_edge(triangles, points), before, 1e-12);
}

TEST(SplitValues, AreLinearOverTheTriangles) {
  const TriangleMesh mesh = builtin_shape("builtin:plane?n=100");
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  std::vector<double> values;
  for (const Point& p : mesh.points) values.insert(values.end(), {1 + 2 * p[0] - 3 * p[1], p[0]});
  const std::vector<double> fine = split_values(topology, values, 2);
  const std::vector<Point> points = split_points(topology, mesh.points);
  ASSERT_EQ(fine.size(), 2 * points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    EXPECT_NEAR(fine[2 * v], 1 + 2 * points[v][0] - 3 * points[v][1], 1e-14);
    EXPECT_NEAR(fine[2 * v + 1], points[v][0], 1e-14);
  }
}

}  // namespace
}  // namespace pelage
