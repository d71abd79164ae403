#include "shape/split_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shape/edges.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double f(const Point& p) { return 1 + 2 * p[0] - p[1] + 0.5 * p[2]; }

/// A long bar with a linear function at vertices and at corners, and numbers of faces.
TriangleMesh bar() {
  TriangleMesh mesh = builtin_shape("builtin:cube");
  for (Point& p : mesh.points) p[0] *= 7;
  Attribute vertex{"v", 1, Domain::vertex, {}}, corner{"c", 1, Domain::corner, {}}, face{"f", 1, Domain::face, {}};
  for (const Point& p : mesh.points) vertex.values.push_back(f(p));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t v : mesh.triangles[t]) corner.values.push_back(f(mesh.points[at(v)]));
    face.values.push_back(static_cast<double>(t));
  }
  mesh.set(vertex);
  mesh.set(corner);
  mesh.set(face);
  return mesh;
}

double area(const TriangleMesh& mesh, std::size_t t) {
  const auto p = [&](std::size_t k) { return mesh.points[at(mesh.triangles[t][k])]; };
  return length(cross(difference(p(1), p(0)), difference(p(2), p(0)))) / 2;
}

TEST(SplitEdges, LeavesNoneThatIsLongerAndTheSurfaceClosed) {
  const TriangleMesh before = bar();
  TriangleMesh mesh = before;
  const double longest = 0.3;
  split_long_edges(mesh, longest, 1'000'000);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(length(difference(mesh.points[at(t[k])], mesh.points[at(t[(k + 1) % 3])])), longest);
  const EdgeTable edges(mesh.triangles, mesh.points.size());
  for (std::size_t e = 0; e < edges.size(); ++e) EXPECT_EQ(edges[e].size(), 2U);
  EXPECT_TRUE(std::equal(before.points.begin(), before.points.end(), mesh.points.begin()));
  // Every face keeps its area, and linear functions are linear.
  std::vector<double> sum(before.triangles.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum[static_cast<std::size_t>(mesh.find("f")->values[t])] += area(mesh, t);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(mesh.find("c")->values[3 * t + k], f(mesh.points[at(mesh.triangles[t][k])]), 1e-12);
  }
  for (std::size_t t = 0; t < sum.size(); ++t) EXPECT_NEAR(sum[t], area(before, t), 1e-12);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_NEAR(mesh.find("v")->values[v], f(mesh.points[v]), 1e-12);
}

TEST(SplitEdges, StopsAtSoManyTriangles) {
  TriangleMesh mesh = bar();
  split_long_edges(mesh, 1e-9, 5000);
  EXPECT_GT(mesh.triangles.size(), 1000U);
  EXPECT_LT(mesh.triangles.size(), 25000U);
}

TEST(SplitEdges, AllAtOnceAreFour) {
  TriangleMesh mesh = bar();
  const std::size_t before = mesh.triangles.size();
  EXPECT_TRUE(split_edges(mesh, 0));
  EXPECT_EQ(mesh.triangles.size(), 4 * before);
  EXPECT_FALSE(split_edges(mesh, 100));
}

}  // namespace
}  // namespace pelage
