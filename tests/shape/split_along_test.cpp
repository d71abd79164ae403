#include "shape/split_along.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape/generators.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

double height(const Point& p) { return p[2] - 0.3; }

/// Above or below a plane, found on straight edges.
LevelFunction height_on(const TriangleMesh& mesh) {
  return [&mesh](const std::vector<CutPlace>& places) {
    CutSurface at;
    at.vertex = places;
    std::vector<double> values;
    for (const Point& p : at.at_vertices(mesh.points)) values.push_back(height(p));
    return values;
  };
}

TEST(SplitAlong, PutsVerticesOnTheLineAndKeepsTheSurface) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=642");
  const CutSurface cut = split_along(sphere.triangles, sphere.points, height_on(sphere), {});
  const std::vector<Point> points = cut.at_vertices(sphere.points);
  ASSERT_GT(points.size(), sphere.points.size());
  for (std::size_t v = 0; v < sphere.points.size(); ++v) EXPECT_EQ(points[v], sphere.points[v]);
  const testing::MeshFacts before = testing::mesh_facts(sphere),
                           after = testing::mesh_facts({points, cut.triangles, {}});
  EXPECT_NEAR(after.area, before.area, 1e-12);
  EXPECT_EQ(after.euler, 2);
  EXPECT_TRUE(after.closed);
  // Straight through triangles: none has corners far on both sides. Kept a twentieth from vertices, of edges up to
  // 0.17.
  for (const Triangle& t : cut.triangles) {
    double low = 0, high = 0;
    for (const std::int32_t v : t) {
      low = std::min(low, height(points[static_cast<std::size_t>(v)]));
      high = std::max(high, height(points[static_cast<std::size_t>(v)]));
    }
    EXPECT_LT(std::min(-low, high), 0.04 * 0.17);
  }
}

TEST(SplitAlong, CornersKeepWhatTheyHad) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=642");
  Attribute place{"place", 3, Domain::corner, {}};
  for (const Triangle& t : sphere.triangles)
    for (const std::int32_t v : t)
      for (const double x : sphere.points[static_cast<std::size_t>(v)]) place.values.push_back(x);
  const CutSurface cut = split_along(sphere.triangles, sphere.points, height_on(sphere), {});
  const std::vector<Point> points = cut.at_vertices(sphere.points);
  const Attribute now = cut.of(place);
  ASSERT_EQ(now.values.size(), 9 * cut.triangles.size());
  for (std::size_t i = 0; i < now.values.size(); ++i)
    EXPECT_NEAR(now.values[i], points[static_cast<std::size_t>(cut.triangles[i / 9][i / 3 % 3])][i % 3], 1e-12);
}

TEST(SplitAlong, LeavesGentleSlopesAlone) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=642");
  const CutSurface cut = split_along(sphere.triangles, sphere.points, height_on(sphere), {1, 0});
  EXPECT_EQ(cut.triangles, sphere.triangles);
  EXPECT_EQ(cut.vertex.size(), sphere.points.size());
}

}  // namespace
}  // namespace pelage
