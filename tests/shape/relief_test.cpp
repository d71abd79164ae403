#include "shape/relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shape/generators.h"
#include "shape/normals.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

std::vector<double> values_at(const TriangleMesh& mesh, double (*f)(const Point&)) {
  std::vector<double> values;
  for (const Point& p : mesh.points) values.push_back(f(p));
  return values;
}

/// With the exact normals of the unit sphere.
TriangleMesh sphere(int n) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=" + std::to_string(n));
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& p : mesh.points) {
    const Point u = unit(p);
    normal.values.insert(normal.values.end(), u.begin(), u.end());
  }
  mesh.set(std::move(normal));
  return mesh;
}

/// On a plane, linear functions have their gradient everywhere, the border included.
TEST(Relief, GradientsOfLinearFunctionsAreExact) {
  const std::vector<Point> points = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.3, 0.6, 1}};
  const std::vector<Triangle> triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  std::vector<double> values;
  for (const Point& p : points) values.push_back(3 * p[0] - 2 * p[1] + 5);
  for (const Point& g : surface_gradients(triangles, points, values)) {
    EXPECT_NEAR(g[0], 3, 1e-12);
    EXPECT_NEAR(g[1], -2, 1e-12);
    EXPECT_NEAR(g[2], 0, 1e-12);
  }
}

/// The tangential part of the gradient of z on the unit sphere is e_z - z p; errors fall with the square of the edges.
TEST(Relief, GradientsOnASphereAreOfSecondOrder) {
  const auto error = [](int n) {
    const TriangleMesh mesh = sphere(n);
    const auto gradients =
        surface_gradients(mesh.triangles, mesh.points, values_at(mesh, [](const Point& p) { return p[2]; }));
    double sum = 0;
    for (std::size_t v = 0; v < gradients.size(); ++v) {
      const Point& p = mesh.points[v];
      const Point exact = {-p[2] * p[0], -p[2] * p[1], 1 - p[2] * p[2]};
      sum += dot(difference(gradients[v], exact), difference(gradients[v], exact));
    }
    return std::sqrt(sum / static_cast<double>(gradients.size()));
  };
  const double coarse = error(642), fine = error(10242);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(coarse / fine, 10);
}

double waves(const Point& p) { return 0.01 * std::sin(12 * p[0]) * std::cos(9 * p[1]); }

/// Normals that tell of a relief against those of the surface that really has it.
TEST(Relief, TiltedNormalsAreThoseOfTheRaisedSurface) {
  const TriangleMesh mesh = sphere(40962);
  const std::vector<double> height = values_at(mesh, waves);
  const std::vector<Point> tilted = relief_normals(mesh, normals_of(mesh), height);
  const std::vector<Point> real = normals_of(raised(mesh, height));
  double mean = 0, plain = 0;
  for (std::size_t v = 0; v < real.size(); ++v) {
    const auto degrees = [&](const Point& n) {
      return std::acos(std::min(1.0, dot(n, real[v]))) * 180 / std::numbers::pi / static_cast<double>(real.size());
    };
    mean += degrees(tilted[v]);
    plain += degrees(unit(mesh.points[v]));
  }
  EXPECT_LT(mean, 0.2);
  EXPECT_GT(plain, 2.5);
}

TEST(Relief, RaisesAlongNormals) {
  const TriangleMesh mesh = sphere(642);
  const TriangleMesh larger = raised(mesh, std::vector<double>(mesh.points.size(), 0.25));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_NEAR(length(larger.points[v]), 1.25, 1e-12);
}

}  // namespace
}  // namespace pelage
