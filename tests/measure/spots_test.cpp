#include "measure/spots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

/// Caps around the vertices of polyhedra, on the unit sphere.
Spots caps(const std::vector<Point>& centres, double radius) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=10242");
  std::vector<double> values;
  for (const Point& p : sphere.points) {
    double nearest = -1;
    for (const Point& c : centres) nearest = std::max(nearest, dot(unit(c), unit(p)));
    values.push_back(nearest);
  }
  return find_spots(sphere, values, std::cos(radius), true);
}

TEST(Spots, TwelveCapsHaveFiveNeighboursEach) {
  std::vector<Point> icosahedron;
  const double g = std::numbers::phi;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (const Point& p : {Point{0, a, b}, Point{a, b, 0}, Point{b, 0, a}}) icosahedron.push_back(p);
  const Spots spots = caps(icosahedron, 0.2);
  EXPECT_EQ(spots.count, 12U);
  EXPECT_EQ(spots.neighbours, (std::map<std::size_t, std::size_t>{{5, 12}}));
  EXPECT_NEAR(spots.nearest, 2 / std::sqrt(1 + g * g), 0.03);
  EXPECT_NEAR(spots.diameter, 2 * std::sqrt(2 * (1 - std::cos(0.2))), 0.03);
}

/// On the sphere the neighbours that are missing to six are twelve, however the spots lie.
TEST(Spots, TheirNeighboursKnowEuler) {
  for (const int n : {20, 57, 130}) {
    std::vector<Point> spiral;
    for (int i = 0; i < n; ++i) {
      const double z = 1 - (2.0 * i + 1) / n, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
      spiral.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    const Spots spots = caps(spiral, 0.6 / std::sqrt(n));
    EXPECT_EQ(spots.count, static_cast<std::size_t>(n));
    int missing = 0;
    for (const auto& [neighbours, count] : spots.neighbours)
      missing += static_cast<int>(count) * (6 - static_cast<int>(neighbours));
    EXPECT_EQ(missing, 12) << n;
  }
}

/// A triangular lattice on a square: six neighbours inside, and what touches the border is left out.
TEST(Spots, SixInTheLattice) {
  const TriangleMesh plane = builtin_shape("builtin:plane?n=40000");
  Point low = plane.points[0], high = low;
  for (const Point& p : plane.points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  const std::size_t x = 0, y = high[1] - low[1] > high[2] - low[2] ? 1 : 2;
  std::vector<double> values;
  const double k = 2 * std::numbers::pi * 8 / (high[x] - low[x]);
  for (const Point& p : plane.points) {
    const double a = k * (p[x] - low[x] + 0.013), b = k * (p[y] - low[y] + 0.021);
    values.push_back(std::cos(a) + std::cos(-a / 2 + std::numbers::sqrt3 / 2 * b) +
                     std::cos(-a / 2 - std::numbers::sqrt3 / 2 * b));
  }
  const Spots spots = find_spots(plane, values, 1, true);
  ASSERT_EQ(spots.neighbours.size(), 1U);
  EXPECT_EQ(spots.neighbours.begin()->first, 6U);
  EXPECT_GT(spots.neighbours.begin()->second, 25U);
  EXPECT_LT(spots.neighbours.begin()->second, spots.count);
}

TEST(Spots, NoneAreNone) {
  EXPECT_EQ(find_spots(builtin_shape("builtin:sphere?n=642"), std::vector<double>(642, 0), 1, true).count, 0U);
}

}  // namespace
}  // namespace pelage
