#include "shape/isosurface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

constexpr Point lower = {-1.6, -1.5, -0.7}, upper = {1.55, 1.5, 0.75};

FieldValue torus(const Point& p) {
  const double ring = std::hypot(p[0], p[1]), out = ring - 1, distance = std::hypot(out, p[2]);
  return {distance - 0.4, {out / distance * p[0] / ring, out / distance * p[1] / ring, p[2] / distance}};
}

TEST(Isosurface, OfATorusIsATorus) {
  for (double spacing : {0.2, 0.1, 0.05}) {
    const testing::MeshFacts facts = testing::mesh_facts(isosurface(torus, lower, upper, spacing));
    EXPECT_TRUE(facts.closed);
    EXPECT_EQ(facts.euler, 0);
    const double volume = 2 * std::numbers::pi * std::numbers::pi * 0.16;
    EXPECT_NEAR(facts.volume, volume, 5 * spacing * spacing * volume);  // linear interpolation: second order
  }
}

TEST(Isosurface, IsClosedAndManifoldForAnyValues) {
  // Independent random signs at the lattice's nodes meet every case of a tetrahedron and every ambiguity of a cube.
  auto noise = [](const Point& p) -> FieldValue {
    const bool border = std::abs(p[0]) > 0.95 || std::abs(p[1]) > 0.95 || std::abs(p[2]) > 0.95;
    std::uint64_t key = 7;
    for (double x : p) key = hash(key, static_cast<std::uint64_t>(std::lround(10 * x) + 100));
    return {border ? 1 : uniform(key, 0) - 0.5, {0, 0, 0}};
  };
  const testing::MeshFacts facts = testing::mesh_facts(isosurface(noise, {-1, -1, -1}, {1, 1, 1}, 0.1));
  EXPECT_TRUE(facts.closed);
  EXPECT_GT(facts.volume, 0);
}

/// A block around the ball of radius 1, in places that a matrix gives, with the distance from the middle as values.
Grid ball(int n, const std::array<Point, 3>& axes) {
  Grid grid;
  grid.count = {n, n, n};
  std::vector<Point> points;
  grid.set({"distance", 1, Domain::vertex, {}, NumberType::float64});
  grid.set({"x", 1, Domain::vertex, {}, NumberType::int32});
  for (std::int32_t v = 0; v < n * n * n; ++v) {
    const double at[] = {double(v % n), double(v / n % n), double(v / n / n)};
    Point p{};
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t k = 0; k < 3; ++k) p[k] += axes[d][k] * (2.6 * at[d] / (n - 1) - 1.3);
    points.push_back(p);
    grid.attributes[0].values.push_back(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
    grid.attributes[1].values.push_back(std::round(10 * p[0]));
  }
  grid.points = points;
  return grid;
}

TEST(Isosurface, OfValuesOnAGridFacesToWhereTheyAreLower) {
  for (const double hand : {1, -1}) {  // axes of either hand
    const Grid grid = ball(25, {{{hand, 0, 0}, {0, 1, 0}, {0, 0.2, 1}}});
    const std::vector<double>& distance = grid.find("distance")->values;
    std::vector<double> depth;
    for (const double r : distance) depth.push_back(-r);
    const TriangleMesh mesh = isosurface(grid, depth, -1);
    const testing::MeshFacts facts = testing::mesh_facts(mesh);
    EXPECT_TRUE(facts.closed);
    EXPECT_EQ(facts.euler, 2);
    EXPECT_NEAR(facts.volume, 4 * std::numbers::pi / 3, 0.05);
    EXPECT_NEAR(testing::mesh_facts(isosurface(grid, distance, 1)).volume, -facts.volume, 1e-12);
    // Linear between the nodes: as far from the level as the margin lets it.
    ASSERT_EQ(mesh.find("distance")->values.size(), mesh.points.size());
    for (const double r : mesh.find("distance")->values) EXPECT_NEAR(r, 1, 0.002);
    EXPECT_EQ(mesh.find("x")->type, NumberType::float64);
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      EXPECT_NEAR(mesh.find("x")->values[v], 10 * mesh.points[v][0], 0.51);
  }
}

/// A plane across an even block is found where it is, and ends at the border.
TEST(Isosurface, OfAnEvenGridIsExactForLinearValues) {
  Grid grid;
  grid.count = {5, 4, 3};
  grid.spacing = {0.5, 1, 2};
  std::vector<double> values;
  for (std::int32_t v = 0; v < 60; ++v) values.push_back(3 * grid.point(v)[0]);
  const TriangleMesh mesh = isosurface(grid, values, 2);
  EXPECT_FALSE(mesh.triangles.empty());
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](int k) { return testing::vec(mesh.points[static_cast<std::size_t>(t[k])]); };
    const auto twice = (at(1) - at(0)).cross(at(2) - at(0));
    EXPECT_LT(twice[0], 0);  // to the lower values
    area += twice.norm() / 2;
  }
  EXPECT_NEAR(area, 3 * 4, 1e-12);
  for (const Point& p : mesh.points) EXPECT_NEAR(p[0], 2.0 / 3, 1e-15);
}

TEST(ProjectToSurface, ReachesTheNearestPointOfADistance) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double u = 6.28 * uniform(2, 3 * i), v = 6.28 * uniform(2, 3 * i + 1), r = 0.2 + 0.4 * uniform(2, 3 * i + 2);
    auto at = [&](double radius) {
      return Point{(1 + radius * std::cos(v)) * std::cos(u), (1 + radius * std::cos(v)) * std::sin(u),
                   radius * std::sin(v)};
    };
    const Point found = project_to_surface(torus, at(r), 0.05);
    EXPECT_LT((testing::vec(found) - testing::vec(at(0.4))).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace pelage
