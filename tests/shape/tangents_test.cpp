#include "shape/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shape/vectors.h"

namespace pelage {
namespace {

using std::numbers::pi;

/// A cylinder around z, u around it, which is mirrored beyond x = 0 where asked.
TriangleMesh cylinder(int around, int up, bool mirrored) {
  TriangleMesh mesh;
  Attribute normal{"normal", 3, Domain::vertex, {}}, uv{"uv", 2, Domain::corner, {}};
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      mesh.points.push_back({std::cos(angle), std::sin(angle), static_cast<double>(j) / up});
      normal.values.insert(normal.values.end(), {std::cos(angle), std::sin(angle), 0});
    }
  const auto add = [&](std::array<std::array<int, 2>, 3> corners) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = corners[k];
      t[k] = j * around + i % around;
      const double u = static_cast<double>(i) / around;
      uv.values.push_back(mirrored && corners[0][0] >= around / 2 ? 1 - u : u);
      uv.values.push_back(static_cast<double>(j) / up);
    }
    mesh.triangles.push_back(t);
  };
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < around; ++i) {
      const int right = i + 1;
      // The first corner says which half it is.
      add({{{i, j}, {right, j}, {right, j + 1}}});
      add({{{i, j}, {right, j + 1}, {i, j + 1}}});
    }
  mesh.set(std::move(normal));
  mesh.set(std::move(uv));
  return mesh;
}

/// By symmetry the tangents are those of the circle.
TEST(Tangents, OfACylinderGoAroundIt) {
  const TriangleMesh mesh = cylinder(16, 3, false);
  const Attribute t = corner_tangents(mesh);
  ASSERT_EQ(t.values.size(), 12 * mesh.triangles.size());
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Point& p = mesh.points[static_cast<std::size_t>(mesh.triangles[c / 3][c % 3])];
    const double* tangent = &t.values[4 * c];
    // At the seam and the rims a corner has triangles on one side only: half an edge of error.
    const bool inside = p[2] > 0 && p[2] < 1 && std::abs(p[1]) > 0.1;
    EXPECT_NEAR(-p[1] * tangent[0] + p[0] * tangent[1], 1, inside ? 1e-12 : 0.02);
    EXPECT_NEAR(dot({p[0], p[1], 0}, {tangent[0], tangent[1], tangent[2]}), 0, 1e-12);
    EXPECT_EQ(tangent[3], 1);
  }
}

TEST(Tangents, WhereUvIsMirroredTheOtherSideIsUp) {
  const TriangleMesh mesh = cylinder(16, 3, true);
  const Attribute t = corner_tangents(mesh);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Triangle& triangle = mesh.triangles[c / 3];
    double y = 0;
    for (const std::int32_t v : triangle) y += mesh.points[static_cast<std::size_t>(v)][1];
    const Point& p = mesh.points[static_cast<std::size_t>(triangle[c % 3])];
    const double side = y > 0 ? 1 : -1;
    EXPECT_EQ(t.values[4 * c + 3], side);
    EXPECT_GT(side * (-p[1] * t.values[4 * c] + p[0] * t.values[4 * c + 1]), 0.98);
  }
}

/// MikkTSpace, by hand: two triangles of a fold share the corners of their common edge, and each counts by its angle.
TEST(Tangents, CountByTheAngle) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.set({"uv", 2, Domain::vertex, {0, 0, 1, 0, 0.2, 1, -1, 0.3}});
  const Point n = unit({-0.2, 0, 1});
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (int v = 0; v < 4; ++v) normal.values.insert(normal.values.end(), n.begin(), n.end());
  mesh.set(std::move(normal));
  const auto flat = [&](const Point& x) {
    Point y = x;
    for (std::size_t k = 0; k < 3; ++k) y[k] -= dot(x, n) * n[k];
    return unit(y);
  };
  const auto angle = [&](const Point& a, const Point& b) { return std::acos(dot(flat(a), flat(b))); };
  // The direction of u solves x(u, v) through the corners.
  const Point first = flat({1, 0, 0});
  const double det = 0.2 * 0.3 + 1 * 1;
  const Point second = flat({0.3 / det * 0 + 1.0 / det, 0.3 / det, -0.5 / det});
  const double a = angle({1, 0, 0}, {0, 1, 0}), b = angle({0, 1, 0}, {-1, 0, 0.5});
  Point expected{};
  for (std::size_t k = 0; k < 3; ++k) expected[k] = a * first[k] + b * second[k];
  expected = unit(expected);
  const Attribute t = corner_tangents(mesh);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(t.values[k], expected[k], 1e-12);
    EXPECT_EQ(t.values[k], t.values[12 + k]);  // of both triangles
  }
}

/// What has no area in the image goes with its neighbours, and what has none at all is something of unit length.
TEST(Tangents, OfDegenerateTrianglesAreThoseOfNeighbours) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.triangles = {{0, 2, 3}, {0, 1, 2}};
  mesh.set({"uv", 2, Domain::vertex, {0, 0, 1, 0, 0, 1, 0, 0.5}});
  mesh.set({"normal", 3, Domain::vertex, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}});
  const Attribute t = corner_tangents(mesh);
  for (const std::size_t corner : {0, 1, 3, 4, 5}) EXPECT_EQ(t.values[4 * corner], 1) << corner;
  EXPECT_NEAR(std::hypot(t.values[8], t.values[9], t.values[10]), 1, 1e-12);
}

}  // namespace
}  // namespace pelage
