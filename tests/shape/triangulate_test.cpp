#include "shape/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace pelage {
namespace {

PolygonMesh polygon(const std::vector<Point>& points) {
  PolygonMesh mesh;
  mesh.points = points;
  for (std::size_t i = 0; i < points.size(); ++i) mesh.corners.push_back(static_cast<std::int32_t>(i));
  mesh.end_face();
  return mesh;
}

/// Twice the signed area seen from +z.
double area2(const TriangleMesh& mesh, const Triangle& t) {
  const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// All triangles counter-clockwise, n - 2 of them, with the polygon's area: then nothing overlaps.
void expect_proper(const std::vector<Point>& points, double twice_area) {
  std::vector<Finding> findings;
  const TriangleMesh mesh = triangulate(polygon(points), findings).mesh;
  EXPECT_TRUE(findings.empty());
  ASSERT_EQ(mesh.triangles.size(), points.size() - 2);
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    EXPECT_GE(area2(mesh, t), 0);
    sum += area2(mesh, t);
  }
  EXPECT_NEAR(sum, twice_area, 1e-12 * twice_area);
}

TEST(Triangulate, ConcavePolygonsDoNotFold) {
  expect_proper({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 16);
  std::vector<Point> star;  // 40 spikes
  double twice_area = 0;
  for (int i = 0; i < 80; ++i) {
    const double r = i % 2 ? 1 : 5, angle = 2 * M_PI * i / 80;
    star.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    twice_area += 5 * std::sin(2 * M_PI / 80);
  }
  expect_proper(star, twice_area);
}

TEST(Triangulate, ConcaveQuadIsCutAtItsReflexCorner) {
  for (int turn = 0; turn < 4; ++turn) {
    std::vector<Point> dart = {{0, 0, 0}, {2, 1, 0}, {0, 4, 0}, {0.5, 1, 0}};
    std::rotate(dart.begin(), dart.begin() + turn, dart.end());
    expect_proper(dart, 6);
  }
}

TEST(Triangulate, PolygonWithAHoleOnABridge) {
  std::vector<Point> ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                             {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  for (std::size_t turn = 0; turn < ring.size(); ++turn) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    expect_proper(ring, 24);
  }
}

TEST(Triangulate, CollinearCornersAndFarFromTheOrigin) {
  expect_proper({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}}, 8);
  const double far = 1e9;
  expect_proper({{far, far, 0}, {far + 4, far, 0}, {far + 4, far + 3, 0}, {far + 2, far + 1, 0}, {far, far + 3, 0}},
                16);
}

TEST(Triangulate, QuadGetsTheBetterDiagonal) {
  std::vector<Finding> findings;
  const auto rhombus = triangulate(polygon({{-5, 0, 0}, {0, -1, 0}, {5, 0, 0}, {0, 1, 0}}), findings).mesh;
  EXPECT_EQ(rhombus.triangles[0], (Triangle{1, 2, 3}));
  EXPECT_EQ(rhombus.triangles[1], (Triangle{1, 3, 0}));
}

TEST(Triangulate, DegeneratePolygonsStillGiveTriangles) {
  std::vector<Finding> findings;
  EXPECT_EQ(
      triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}), findings).mesh.triangles.size(),
      3u);
  EXPECT_EQ(triangulate(polygon({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), findings).mesh.triangles.size(), 2u);
  findings.clear();  // a pentagram crosses itself
  EXPECT_EQ(
      triangulate(polygon({{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}}), findings).mesh.triangles.size(),
      3u);
  EXPECT_TRUE(findings.empty() || findings[0].kind == "crossing-faces");
}

TEST(Triangulate, QuadsThatShareTwoEdgesDoNotMakeOneTriangleTwice) {
  // Vertex 4 lies in two quads only; the diagonal 1-3 would be better in both, but doubles the triangle 1 4 3.
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, -1, 0}, {2, 0, 0.1}};
  mesh.corners = {0, 3, 4, 1, 2, 1, 4, 3};
  mesh.face_ends = {4, 8};
  std::vector<Finding> findings;
  std::map<std::set<std::int32_t>, int> times;
  for (const Triangle& t : triangulate(mesh, findings).mesh.triangles)
    EXPECT_EQ(++times[std::set<std::int32_t>(t.begin(), t.end())], 1);
}

TEST(Triangulate, CornerAttributesFollow) {
  PolygonMesh mesh = polygon({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}});
  Attribute tag{"tag", 2, Domain::corner, {}};
  for (int c = 0; c < 5; ++c) tag.values.insert(tag.values.end(), {10.0 + c, 20.0 + c});
  mesh.attributes.push_back(tag);
  std::vector<Finding> findings;
  const TriangleMesh cut = triangulate(mesh, findings).mesh;
  const Attribute& out = cut.attributes.at(0);
  ASSERT_EQ(out.values.size(), 2 * 3 * cut.triangles.size());
  for (std::size_t c = 0; c < 3 * cut.triangles.size(); ++c) {
    EXPECT_EQ(out.values[2 * c], 10.0 + cut.triangles[c / 3][c % 3]);
    EXPECT_EQ(out.values[2 * c + 1], 20.0 + cut.triangles[c / 3][c % 3]);
  }
}

TEST(Triangulate, SmallFacesAreLeftOutAndFacesKeepTheirNumbers) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 0, 1, 2, 3, 2, 0, 1, 2};
  mesh.face_ends = {2, 6, 7, 7, 10};
  std::vector<Finding> findings;
  const Triangulation cut = triangulate(mesh, findings);
  EXPECT_EQ(cut.source_face, (std::vector<std::int32_t>{1, 1, 4}));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "small-faces");
  EXPECT_EQ(findings[0].count, 3u);
  EXPECT_EQ(findings[0].element, 0u);
}

TEST(Triangulate, RefusesNumbersOutOfRangeAndHugeFaces) {
  std::vector<Finding> findings;
  for (std::int32_t bad : {-1, 3, 2147483647}) {
    PolygonMesh mesh = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    mesh.corners[1] = bad;
    EXPECT_THROW(triangulate(mesh, findings), ShapeFault);
  }
  EXPECT_THROW(triangulate(polygon(std::vector<Point>(20001)), findings), ShapeFault);
}

}  // namespace
}  // namespace pelage
