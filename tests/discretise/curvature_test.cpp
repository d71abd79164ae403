#include "discretise/curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "discretise/sampling.h"
#include "shape/generators.h"
#include "support/discretisations.h"

namespace pelage {
namespace {

struct Curved {
  PrincipalCurvatures k;
  std::vector<Point> place;
};

Curved at_vertices(const std::string& shape, const std::string& method) {
  const TriangleMesh mesh = builtin_shape(shape);
  const Discretisation d = make_discretisation(method, make_topology(mesh.points.size(), mesh.triangles));
  const auto control = method == "loop" ? interpolating_control(d, mesh.points) : mesh.points;
  return {principal_curvatures(vertex_curvature(d, control), limit_normals(d, control)), mesh.points};
}

/// Largest distance from 1 on the unit sphere.
double sphere_error(const std::string& shape, const std::string& method) {
  const Curved c = at_vertices(shape, method);
  double worst = 0;
  for (std::size_t i = 0; i < c.place.size(); ++i)
    worst = std::max({worst, std::abs(c.k.k1[i] - 1), std::abs(c.k.k2[i] - 1)});
  return worst;
}

TEST(Curvature, SphereHasTheInverseRadiusEverywhere) {
  // The largest error is at the twelve vertices of valence 5.
  EXPECT_LT(sphere_error("builtin:sphere?n=2562", "loop"), 0.05);
  EXPECT_LT(sphere_error("builtin:sphere?n=2562", "linear"), 0.05);
}

/// Area integral of k1 k2: 2 pi times the Euler characteristic, whatever the shape.
double total_gaussian_curvature(const TriangleMesh& mesh) {
  const Discretisation d = loop_discretisation(make_topology(mesh.points.size(), mesh.triangles));
  const QuadratureGeometry g = quadrature_geometry(d, mesh.points);
  const PrincipalCurvatures k = principal_curvatures(quadrature_curvature(d, mesh.points), g.normal);
  double sum = 0;
  for (std::size_t q = 0; q < g.weight.size(); ++q) sum += g.weight[q] * k.k1[q] * k.k2[q];
  return sum;
}

TEST(Curvature, ObeysGaussAndBonnet) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(total_gaussian_curvature(builtin_shape("builtin:animal?n=3000")), 4 * pi, 0.02 * 4 * pi);
  EXPECT_NEAR(total_gaussian_curvature(builtin_shape("builtin:torus?n=2000")), 0, 1e-3);
}

TEST(Curvature, TorusHasThatOfItsTube) {
  // One principal curvature of a torus is 1 / (radius of the tube) everywhere.
  for (const char* method : {"loop", "linear"}) {
    const Curved c = at_vertices("builtin:torus?n=8000", method);
    double high = 0;
    for (const Point& p : c.place) high = std::max(high, p[2]);
    const double tube = high;
    for (const double k1 : c.k.k1) ASSERT_NEAR(k1 * tube, 1, 0.02) << method;
  }
}

TEST(Curvature, ChangesItsSignWithTheOrientation) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  const Discretisation d = loop_discretisation(make_topology(mesh.points.size(), mesh.triangles));
  const PrincipalCurvatures k = principal_curvatures(vertex_curvature(d, mesh.points), limit_normals(d, mesh.points));
  for (const double k1 : k.k1) EXPECT_LT(k1, 0);
}

}  // namespace
}  // namespace pelage
