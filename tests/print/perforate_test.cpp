#include "print/perforate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "print/self_meeting.h"
#include "shape/describe.h"
#include "shape/generators.h"
#include "shape/sample_meshes.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

constexpr double pi = std::numbers::pi;

/// On straight edges, of a function in space.
template <class F>
LevelFunction level_of(const std::vector<Point>& points, F f) {
  return [&points, f](const std::vector<CutPlace>& places) {
    std::vector<double> values;
    for (const CutPlace& p : places) {
      Point x = points[p.from];
      for (std::size_t d = 0; d < 3; ++d) x[d] += p.part * (points[p.to][d] - x[d]);
      values.push_back(f(x));
    }
    return values;
  };
}

template <class F>
TriangleMesh left_of(const TriangleMesh& mesh, F f, std::size_t* islands = nullptr) {
  const PerforatedSurface s = perforated(mesh.triangles, mesh.points, level_of(mesh.points, f));
  if (islands) *islands = s.islands;
  return {s.at_vertices(mesh.points), s.triangles, {}};
}

/// Vertices of the border: how far they are from the level.
template <class F>
double worst_border(const TriangleMesh& mesh, F f) {
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  double worst = 0;
  for (Index v = 0; v < topology.vertex_count; ++v)
    if (topology.on_boundary(v)) worst = std::max(worst, std::abs(f(mesh.points[v])));
  return worst;
}

/// A cap of the sphere: its border is a circle, its area 2 pi (1 - z); the error is that of the polyhedron, h^2.
TEST(Perforate, ACapOfTheSphereConvergesWithSecondOrder) {
  const auto above = [](const Point& p) { return p[2] - 0.3; };
  double before = 0;
  for (const int n : {642, 2562, 10242}) {
    const TriangleMesh rest = left_of(builtin_shape("builtin:sphere?n=" + std::to_string(n)), above);
    const testing::MeshFacts facts = testing::mesh_facts(rest);
    EXPECT_EQ(facts.euler, 1);
    EXPECT_GT(facts.smallest_angle, 3);
    const double error = std::abs(facts.area - 2 * pi * 1.3);
    if (before > 0) {
      EXPECT_LT(error, before / 3);
    }
    before = error;
  }
  EXPECT_LT(before, 5e-3);
}

/// The border lies on the line itself, but for vertices next to which it may not pass.
TEST(Perforate, TheBorderIsOnTheLine) {
  const TriangleMesh mesh = builtin_shape("builtin:torus?n=2304");
  const auto f = [](const Point& p) { return std::sin(7 * p[0]) * std::sin(7 * p[1]) * std::cos(7 * p[2]) - 0.1; };
  const TriangleMesh rest = left_of(mesh, f);
  EXPECT_LT(worst_border(rest, f), 0.08);
  const auto g = [](const Point& p) { return p[2] - 0.05; };
  EXPECT_LT(worst_border(left_of(mesh, g), g), 1e-8);
}

/// k holes make Euler's number 2 - k.
TEST(Perforate, HolesCount) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=10242");
  const auto six = [](const Point& p) {
    double nearest = -1;
    for (const double x : p) nearest = std::max(nearest, std::abs(x) - 0.9);
    return nearest;
  };
  const TriangleMesh rest = left_of(sphere, six);
  EXPECT_EQ(testing::mesh_facts(rest).euler, 2 - 6);
  EXPECT_EQ(describe(rest, {}).boundary_loops, 6U);
}

/// Lines through vertices, along edges and through saddles: squares that touch at their corners.
TEST(Perforate, HolesThatWouldTouchInAVertexStayApart) {
  const TriangleMesh flat = test::sheet(16);
  const auto board = [](const Point& p) { return std::sin(pi * p[0] / 4) * std::sin(pi * p[1] / 4); };
  for (const double shift : {0.0, 1e-3, -1e-3, 0.2}) {
    const TriangleMesh rest = left_of(flat, [&](const Point& p) { return board(p) + shift; });
    const testing::MeshFacts facts = testing::mesh_facts(rest);  // throws where it is no manifold
    EXPECT_GT(facts.smallest_angle, 1) << shift;
    EXPECT_TRUE(self_meetings(rest.triangles, rest.points).empty()) << shift;
  }
}

TEST(Perforate, NoiseLeavesAManifold) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2562");
  std::vector<double> noise;
  for (std::size_t v = 0; v < sphere.points.size(); ++v)
    noise.push_back(std::sin(1e4 * sphere.points[v][0]) + std::cos(1e4 * sphere.points[v][1]) - 0.6);
  const LevelFunction linear = [&](const std::vector<CutPlace>& places) {
    std::vector<double> values;
    for (const CutPlace& p : places) values.push_back(noise[p.from] + p.part * (noise[p.to] - noise[p.from]));
    return values;
  };
  const PerforatedSurface s = perforated(sphere.triangles, sphere.points, linear);
  const TriangleMesh rest{s.at_vertices(sphere.points), s.triangles, {}};
  EXPECT_GT(testing::mesh_facts(rest).smallest_angle, 0.5);
  EXPECT_TRUE(self_meetings(rest.triangles, rest.points).empty());
  EXPECT_EQ(describe(rest, {}).components, 1U);
}

TEST(Perforate, IslandsGoAndPartsOfTheShapeStay) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  const auto n = static_cast<std::int32_t>(mesh.points.size());
  const TriangleMesh one = mesh;
  for (const Point& p : one.points) mesh.points.push_back({p[0] + 5, p[1], p[2]});
  for (const Triangle& t : one.triangles) mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  std::size_t islands = 0;
  const TriangleMesh rest = left_of(
      mesh, [](const Point& p) { return 0.1 - std::abs(p[2] - 0.5); }, &islands);
  EXPECT_EQ(islands, 2U);  // the cap of either ball
  EXPECT_EQ(describe(rest, {}).components, 2U);
  for (const Point& p : rest.points) EXPECT_LT(p[2], 0.41);
}

TEST(Perforate, NothingAndAll) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  const TriangleMesh all = left_of(mesh, [](const Point&) { return -1.0; });
  EXPECT_EQ(all.points, mesh.points);
  EXPECT_EQ(all.triangles, mesh.triangles);
  EXPECT_TRUE(left_of(mesh, [](const Point&) { return 1.0; }).triangles.empty());
}

TEST(Perforate, AttributesOfAllKindsFollow) {
  TriangleMesh mesh = test::sheet(8);
  Attribute x{"x", 1, Domain::vertex, {}}, corner{"cx", 1, Domain::corner, {}}, face{"f", 1, Domain::face, {}};
  for (const Point& p : mesh.points) x.values.push_back(p[0]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    face.values.push_back(static_cast<double>(t));
    for (const std::int32_t v : mesh.triangles[t]) corner.values.push_back(mesh.points[v][0]);
  }
  const PerforatedSurface s =
      perforated(mesh.triangles, mesh.points, level_of(mesh.points, [](const Point& p) { return p[0] + p[1] - 7.3; }));
  const std::vector<Point> points = s.at_vertices(mesh.points);
  const Attribute x_now = s.of(x), corner_now = s.of(corner), face_now = s.of(face);
  for (std::size_t v = 0; v < points.size(); ++v) EXPECT_NEAR(x_now.values[v], points[v][0], 1e-12);
  std::size_t moved = 0;  // corners belong to triangles, whose vertices may have moved along edges of others
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    EXPECT_EQ(face_now.values[t], static_cast<double>(s.parent[t]));
    for (std::size_t k = 0; k < 3; ++k)
      moved += std::abs(corner_now.values[3 * t + k] - points[s.triangles[t][k]][0]) > 0.16;
  }
  EXPECT_EQ(moved, 0U);
}

}  // namespace
}  // namespace pelage
