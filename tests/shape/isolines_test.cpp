#include "shape/isolines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "sample_meshes.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using std::numbers::pi;
constexpr std::uint8_t line = 2;

std::vector<double> values(const TriangleMesh& mesh, const std::function<double(const Point&)>& u) {
  std::vector<double> result;
  for (const Point& p : mesh.points) result.push_back(u(p));
  return result;
}

SurfacePart above(const TriangleMesh& mesh, const std::vector<double>& u) {
  return part_above(whole_surface(mesh.triangles, mesh.points.size()), u, line);
}

std::vector<Chain> lines_of(const SurfacePart& part) {
  return border_chains(part, [](std::uint8_t mark) { return mark == line; });
}

double length_of(const Chain& chain, const std::vector<Point>& points) {
  double sum = 0;
  const std::size_t n = chain.vertices.size();
  for (std::size_t i = chain.closed ? 0 : 1; i < n; ++i)
    sum += length(difference(points[chain.vertices[i]], points[chain.vertices[(i + n - 1) % n]]));
  return sum;
}

double area_of(const SurfacePart& part, const std::vector<Point>& points) {
  double sum = 0;
  for (const Triangle& t : part.triangles)
    sum += length(cross(difference(points[t[1]], points[t[0]]), difference(points[t[2]], points[t[0]]))) / 2;
  return sum;
}

struct Errors {
  double length, area;
};

/// Of the cap x > 0.3 of the unit sphere.
Errors cap_errors(const std::string& shape) {
  const TriangleMesh mesh = builtin_shape(shape);
  const SurfacePart part = above(mesh, values(mesh, [](const Point& p) { return p[0] - 0.3; }));
  const std::vector<Point> points = values_on(part, mesh.points);
  const std::vector<Chain> chains = lines_of(part);
  EXPECT_EQ(chains.size(), 1U);
  EXPECT_TRUE(chains[0].closed);
  return {2 * pi * std::sqrt(1 - 0.09) - length_of(chains[0], points), 2 * pi * 0.7 - area_of(part, points)};
}

TEST(Isolines, ACircleOfASphereToSecondOrder) {
  const Errors coarse = cap_errors("builtin:sphere?n=642"), fine = cap_errors("builtin:sphere?n=10242");
  EXPECT_LT(std::abs(fine.length), 1e-3);
  EXPECT_NEAR(coarse.length / fine.length, 16, 4);
  EXPECT_NEAR(coarse.area / fine.area, 16, 4);
}

TEST(Isolines, TheTwoPartsMakeTheWhole) {
  const TriangleMesh mesh = test::torus();
  const auto u = [](const Point& p) { return std::sin(2 * p[0]) + std::cos(3 * p[1] + p[2]) - 0.1; };
  std::vector<double> up = values(mesh, u), down = up;
  for (double& x : down) x = -x;
  const SurfacePart a = above(mesh, up), b = above(mesh, down);
  const SurfacePart all = whole_surface(mesh.triangles, mesh.points.size());
  EXPECT_NEAR(area_of(a, values_on(a, mesh.points)) + area_of(b, values_on(b, mesh.points)), area_of(all, mesh.points),
              1e-9);
  EXPECT_EQ(lines_of(a).size(), lines_of(b).size());
}

/// Every edge of the part has two triangles or is on the line, each vertex of which is met once from either side.
TEST(Isolines, PartsHaveNoGaps) {
  const TriangleMesh mesh = test::torus(30);
  const SurfacePart part = above(mesh, values(mesh, [](const Point& p) { return std::sin(3 * p[0]) + p[1]; }));
  std::map<std::pair<int, int>, int> balance;
  std::size_t marked = 0, along = 0;
  for (std::size_t f = 0; f < part.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = part.triangles[f][k], b = part.triangles[f][(k + 1) % 3];
      marked += part.border[f][k] == line;
      if (part.border[f][k] == 0) balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0);
  for (const Chain& chain : lines_of(part)) {
    EXPECT_TRUE(chain.closed);
    along += chain.vertices.size();
  }
  EXPECT_EQ(along, marked);
}

TEST(Isolines, AnAnnulusHasTwoLinesThatTurnOppositely) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=2562");
  const SurfacePart part = above(mesh, values(mesh, [](const Point& p) { return 0.25 - p[2] * p[2]; }));
  const std::vector<Point> points = values_on(part, mesh.points);
  const std::vector<Chain> chains = lines_of(part);
  ASSERT_EQ(chains.size(), 2U);
  double turns = 0;  // signed areas in the plane of x and y: the part is to the left
  for (const Chain& c : chains) {
    double area = 0;
    for (std::size_t i = 0; i < c.vertices.size(); ++i) {
      const Point &p = points[c.vertices[i]], &q = points[c.vertices[(i + 1) % c.vertices.size()]];
      area += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
    EXPECT_NEAR(std::abs(area), pi * 0.75, 0.02);
    EXPECT_LT(area * points[c.vertices[0]][2], 0);
    turns += area;
  }
  EXPECT_NEAR(turns, 0, 1e-2);
}

TEST(Isolines, LinesEndAtBorders) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const SurfacePart part = above(mesh, values(mesh, [](const Point& p) { return 0.25 - p[0]; }));
  const std::vector<Chain> open = lines_of(part);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_FALSE(open[0].closed);
  EXPECT_NEAR(length_of(open[0], values_on(part, mesh.points)), 1, 1e-12);
  const std::vector<Chain> around = border_chains(part, [](std::uint8_t) { return true; });
  ASSERT_EQ(around.size(), 1U);
  EXPECT_TRUE(around[0].closed);
  EXPECT_NEAR(length_of(around[0], values_on(part, mesh.points)), 2.5, 1e-12);
}

TEST(Isolines, ALineThroughVerticesHasNoGaps) {
  const TriangleMesh mesh = test::cube();
  const SurfacePart part = above(mesh, values(mesh, [](const Point& p) { return p[0] + p[1] - 1; }));
  const std::vector<Chain> chains = lines_of(part);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_NEAR(length_of(chains[0], values_on(part, mesh.points)), 2 + 2 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(area_of(part, values_on(part, mesh.points)), 3, 1e-12);
}

/// A part of a part keeps what is known of its borders.
TEST(Isolines, CutsFollowEachOther) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=10242");
  const SurfacePart front = above(mesh, values(mesh, [](const Point& p) { return p[2]; }));
  const std::vector<Point> points = values_on(front, mesh.points);
  std::vector<double> u;
  for (const Point& p : points) u.push_back(p[0]);
  const SurfacePart quarter = part_above(front, u, 3);
  const std::vector<Point> ends = values_on(quarter, points);
  for (const int mark : {2, 3}) {
    const auto halves = border_chains(quarter, [mark](std::uint8_t m) { return m == mark; });
    ASSERT_EQ(halves.size(), 1U);
    EXPECT_FALSE(halves[0].closed);
    EXPECT_NEAR(length_of(halves[0], ends), pi, 1e-3);
  }
  EXPECT_NEAR(area_of(quarter, ends), pi, 1e-3);
}

}  // namespace
}  // namespace pelage
