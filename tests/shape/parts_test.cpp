#include "shape/parts.h"

#include <gtest/gtest.h>

#include "shape/describe.h"
#include "shape/repair.h"
#include "shape/sample_meshes.h"

namespace pelage {
namespace {

/// A cube moved along, its triangles one after the other without shared vertices, or with.
void add_cube(TriangleMesh& mesh, Point shift, int object, bool soup) {
  const TriangleMesh cube = test::cube();
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  const auto moved = [&](Point p) {
    for (std::size_t k = 0; k < 3; ++k) p[k] += shift[k];
    return p;
  };
  if (!soup)
    for (const Point& p : cube.points) mesh.points.push_back(moved(p));
  for (const Triangle& t : cube.triangles) {
    Triangle here;
    for (std::size_t k = 0; k < 3; ++k) {
      here[k] = first + t[k];
      if (!soup) continue;
      here[k] = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.push_back(moved(cube.points[t[k]]));
    }
    mesh.triangles.push_back(here);
    mesh.find("object")->values.push_back(object);
  }
}

TriangleMesh empty_objects() {
  TriangleMesh mesh;
  mesh.set({"object", 1, Domain::face, {}, NumberType::int32, {"a", "b", "c", "d", "e", "f"}});
  return mesh;
}

/// Vertices in one place become one, whatever their part.
void share_vertices(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t)
      v = static_cast<std::int32_t>(std::ranges::find(mesh.points, mesh.points[v]) - mesh.points.begin());
}

MeshReport report_of(TriangleMesh mesh) {
  std::vector<Finding> findings;
  TriangleMesh repaired = repair(std::move(mesh), findings);
  return describe(repaired, findings);
}

/// By a face, by an edge, by a corner; as soup (STL), with vertices of their own (OBJ), and with shared ones.
TEST(Parts, ClosedPartsThatTouchStayTwo) {
  const TriangleMesh cube = test::cube();
  const double side = report_of(cube).high[0] - report_of(cube).low[0];
  for (const Point& direction : {Point{1, 0, 0}, Point{1, 1, 0}, Point{1, 1, 1}})
    for (const bool soup : {true, false})
      for (const bool shared : {true, false}) {
        TriangleMesh mesh = empty_objects();
        add_cube(mesh, {0, 0, 0}, 0, soup);
        add_cube(mesh, {side * direction[0], side * direction[1], side * direction[2]}, 1, soup);
        if (shared) share_vertices(mesh);
        const MeshReport report = report_of(mesh);
        EXPECT_EQ(report.components, 2U);
        EXPECT_TRUE(report.closed);
        EXPECT_EQ(report.vertices, 16U);
        EXPECT_NEAR(report.volume, 2 * side * side * side, 1e-12);
      }
}

/// As programs for flows write them: every side of a body is a solid of its own.
TEST(Parts, PiecesOfOneSurfaceAreJoined) {
  TriangleMesh mesh = empty_objects();
  add_cube(mesh, {0, 0, 0}, 0, true);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) mesh.find("object")->values[f] = static_cast<double>(f / 2);
  const MeshReport report = report_of(mesh);
  EXPECT_EQ(report.components, 1U);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.vertices, 8U);
}

TEST(Parts, OpenPartsThatTouchStayTwo) {
  TriangleMesh mesh = empty_objects();
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.find("object")->values = {0, 1};
  MeshReport report = report_of(mesh);
  EXPECT_EQ(report.components, 2U);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].kind, "parts-apart");
  mesh.find("object")->values = {0, 0};
  EXPECT_EQ(report_of(mesh).components, 1U);
}

}  // namespace
}  // namespace pelage
