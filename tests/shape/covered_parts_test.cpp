#include "shape/covered_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "shape/cell_shapes.h"
#include "shape/cells.h"
#include "shape/generators.h"
#include "shape/soup_orient.h"
#include "shape/vectors.h"
#include "shape/winding_tree.h"
#include "support/soups.h"

namespace pelage {
namespace {

constexpr double pi = std::numbers::pi;

TriangleMesh sphere() { return builtin_shape("builtin:sphere?n=5000"); }

/// A box from a to a + size, its six sides without a common vertex; open below where asked.
TriangleMesh box(const Point& a, const Point& size, bool open = false) {
  TriangleMesh mesh = six_squares();
  if (open) mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
  for (Point& p : mesh.points)
    for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + size[k] * p[k];
  return mesh;
}

TriangleMesh both(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh = a;
  const auto first = static_cast<std::int32_t>(a.points.size());
  mesh.points.insert(mesh.points.end(), b.points.begin(), b.points.end());
  for (const Triangle& t : b.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return mesh;
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += length(cross(difference(mesh.points[t[1]], mesh.points[t[0]]),
                        difference(mesh.points[t[2]], mesh.points[t[0]]))) /
           2;
  return sum;
}

double seen_area(const TriangleMesh& mesh) {
  const auto covered = CoveredParts::of(shared(mesh));
  return area_of(mesh) * (covered ? 1 - covered->share() : 1);
}

TEST(WindingTree, IsOneInsideAndNothingOutside) {
  const TriangleMesh animal = builtin_shape("builtin:torus?n=3000");
  std::vector<WindingTree::Corners> corners;
  for (const Triangle& t : animal.triangles)
    corners.push_back({animal.points[t[0]], animal.points[t[1]], animal.points[t[2]]});
  const WindingTree tree(corners);
  const DistanceTree distance(animal);
  int inside = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Point p = {4 * uniform(1, i) - 2, 4 * uniform(2, i) - 2, 2 * uniform(3, i) - 1};
    if (distance.distance(p) < 0.05) continue;
    const double w = tree.number(p), whole = std::round(w);
    EXPECT_NEAR(w, whole, 0.05);
    inside += whole == 1;
  }
  EXPECT_GT(inside, 20);
}

/// Of two unit spheres at a distance d the caps of a height of 1 - d / 2 are covered.
TEST(CoveredParts, AreTheCapsOfSpheresThatMeet) {
  for (const double d : {0.6, 1.2, 1.9}) {
    const TriangleMesh two = two_spheres(d, sphere());
    EXPECT_NEAR(seen_area(two) / (4 * pi * (1 + d / 2)), 1, 0.003) << d;
    const auto covered = CoveredParts::of(shared(two));
    const auto half = static_cast<std::int32_t>(two.triangles.size() / 2);
    for (std::int32_t f = 0; f < 2 * half; ++f) {
      const Point p = two.points[static_cast<std::size_t>(two.triangles[static_cast<std::size_t>(f)][0])];
      const double other = length(difference(p, {f < half ? d : 0, 0, 0}));
      if (std::abs(other - 1) > 0.01) {
        EXPECT_EQ(covered->covers(f, p), other < 1) << f;
      }
    }
  }
  for (const double d : {2.0, 2.01}) EXPECT_EQ(CoveredParts::of(shared(two_spheres(d, sphere()))), nullptr);
}

/// What is seen of two boxes is the area of their union: stuck into each other, side by side on a common face, and with
/// faces in one plane.
TEST(CoveredParts, LeaveTheAreaOfTheUnion) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(seen_area(both(cube, box({0.25, 0.25, 0.5}, {0.5, 0.5, 1}))), 6 + 4 * 0.5 * 0.5, 0.02);
  EXPECT_NEAR(seen_area(both(cube, box({0.25, 0.25, 1}, {0.5, 0.5, 1}))), 6 + 4 * 0.5, 0.02);
  EXPECT_NEAR(seen_area(both(cube, box({0.5, 0, 0}, {1, 1, 1}))), 8, 0.02);
}

/// A leg without an upper end encloses what it is stuck into; a cup that stands on a table nothing.
TEST(CoveredParts, CloseOpeningsThatAreInside) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1}), leg = box({0.25, 0.25, 0.9}, {0.5, 0.5, 1}, true);
  EXPECT_NEAR(seen_area(both(cube, leg)), 6 + 4 * 0.5 * 0.9, 0.02);
  TriangleMesh table;
  add_square(table, {-1, -1, 0.9}, {3, 0, 0}, {0, 3, 0}, 8);
  EXPECT_EQ(CoveredParts::of(shared(both(table, leg))), nullptr);
}

TEST(CoveredParts, KeepWhatLiesWhollyInside) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(CoveredParts::of(shared(both(cube, box({0.2, 0.2, 0.2}, {0.5, 0.5, 0.5})))), nullptr);
  EXPECT_NEAR(seen_area(both(sphere(), sphere())), area_of(sphere()), 1e-6);  // a copy is none
}

/// Parts that meet have their outsides outside, whatever the file says of either.
TEST(CoveredParts, AreOutsideOut) {
  TriangleMesh two = two_spheres(1.2, sphere());
  const std::size_t half = two.triangles.size() / 2;
  for (std::size_t f = 0; f < half; ++f) std::swap(two.triangles[f][1], two.triangles[f][2]);
  EXPECT_EQ(orient_soup(two), half);
  EXPECT_EQ(orient_soup(two), 0u);
  EXPECT_NEAR(seen_area(two) / (4 * pi * 1.6), 1, 0.003);
}

/// All cells are seen, even at the circle, and theirs is the area that is seen.
TEST(CoveredParts, HaveNoCells) {
  constexpr double d = 1.2;
  const TriangleMesh two = two_spheres(d, sphere());
  const auto half = static_cast<std::int32_t>(two.triangles.size() / 2);
  const Cells cells = make_cells(shared(two), 4000);
  const CellShapes shapes(cells);
  CellShapes::Scratch scratch;
  double sum = 0, at_circle = 0;
  int near = 0, across = 0;
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    const Point& p = cells.points[i];
    EXPECT_GT(length(difference(p, {cells.face[i] < half ? d : 0, 0, 0})), 0.995);
    const PlaneCell shape = shapes.shape(i, scratch);
    sum += shape.area();
    if (std::abs(p[0] - d / 2) > cells.radius / 4) continue;
    at_circle += shape.area();
    ++near;
    for (const PlaneCell::Beyond& b : shape.beyond)
      across += b.cell >= 0 && (cells.face[static_cast<std::size_t>(b.cell)] < half) != (cells.face[i] < half);
  }
  EXPECT_NEAR(sum / (4 * pi * (1 + d / 2)), 1, 0.015);
  EXPECT_GT(across, near);
  EXPECT_NEAR(at_circle / near / (sum / static_cast<double>(cells.nodes())), 1, 0.05);
}

}  // namespace
}  // namespace pelage
