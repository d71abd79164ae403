#include "discretise/simulation_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretise/discretisation.h"
#include "pelage/error.h"
#include "shape/generators.h"
#include "shape/locate.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

constexpr std::size_t no_limit = 1'000'000;

/// A shape, the levels that its mesh needed, and the mesh.
struct Meshed {
  TriangleMesh shape;
  Hierarchy levels;
  std::vector<Point> control;
  SimulationMesh mesh;

  Meshed(const std::string& name, double edge, std::vector<double> edges = {})
      : shape(builtin_shape(name)),
        levels(make_topology(shape.points.size(), shape.triangles), loop_refine),
        control(loop_interpolation(levels.topology(0), shape.points)),
        mesh(levels, control, {edge, std::move(edges)}, no_limit) {}
  std::vector<Point> points() const { return mesh.points(control); }
};

TEST(SimulationMesh, LiesOnTheLimitSurfaceWithEvenEdges) {
  const Meshed sphere("builtin:sphere?n=642", 0.06);
  const std::vector<Point> points = sphere.points();
  for (const Point& p : points) EXPECT_NEAR(length(p), 1, 2e-4);
  double sum = 0, shortest = 1, longest = 0;
  const std::vector<Triangle>& triangles = sphere.mesh.shared_topology()->triangles;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const double edge =
          length(difference(points[static_cast<std::size_t>(t[k])], points[static_cast<std::size_t>(t[(k + 1) % 3])]));
      sum += edge;
      shortest = std::min(shortest, edge);
      longest = std::max(longest, edge);
    }
  EXPECT_NEAR(sum / static_cast<double>(3 * triangles.size()), 0.06, 0.002);
  EXPECT_GT(shortest, 0.03);
  EXPECT_LT(longest, 0.1);
}

TEST(SimulationMesh, GoesWithItsControlPoints) {
  const Meshed animal("builtin:animal?n=2000", 0.05);
  std::vector<Point> moved = animal.control;
  for (Point& p : moved)
    for (double& x : p) x = 2 * x + 1;
  const std::vector<Point> before = animal.points(), after = animal.mesh.points(moved);
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[i][k], 2 * before[i][k] + 1, 1e-12);
}

TEST(SimulationMesh, ReadsTheShapeLinearlyOverItsTriangles) {
  const Meshed sphere("builtin:sphere?n=2562", 0.03);
  ASSERT_GT(sphere.levels.finest(), 0);
  std::vector<double> z;
  Attribute corners{"z", 1, Domain::corner, {}};
  for (const Point& p : sphere.shape.points) z.push_back(p[2]);
  for (const Triangle& t : sphere.shape.triangles)
    for (const Index v : t) corners.values.push_back(z[static_cast<std::size_t>(v)]);
  const std::vector<double> values = sphere.mesh.values(z, 1), of_corners = sphere.mesh.values(corners).values;
  EXPECT_EQ(values, of_corners);
  const std::vector<Point> points = sphere.points();
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(values[i], points[i][2], 2e-3);  // edge^2 / 4
}

TEST(SimulationMesh, IsGradedAsItsEdgesAre) {
  const TriangleMesh shape = builtin_shape("builtin:sphere?n=2562");
  std::vector<double> edges;
  for (const Point& p : shape.points) edges.push_back(0.03 * (2 + p[2]));
  const Meshed sphere("builtin:sphere?n=2562", 0.03, edges);
  const auto above = std::ranges::count_if(sphere.points(), [](const Point& p) { return p[2] > 0; });
  // The integral of 1 / edge^2 over the two halves: (1/2 - 1/3) against (1 - 1/2).
  const double share = static_cast<double>(above) / static_cast<double>(sphere.mesh.vertices());
  EXPECT_NEAR(share, 0.25, 0.02);
}

TEST(SimulationMesh, AFewLongTrianglesAreNoReasonToSplitAll) {
  // A box of small squares with one side in two triangles would need eight levels for that side alone.
  TriangleMesh plane = builtin_shape("builtin:plane?n=900");
  const auto n = static_cast<Index>(plane.points.size());
  plane.points.insert(plane.points.end(), {{0, -8, 0}, {1, -8, 0}, {0, -9, 0}, {1, -9, 0}});
  plane.triangles.insert(plane.triangles.end(), {{n, n + 2, n + 3}, {n, n + 3, n + 1}});
  Hierarchy levels(make_topology(plane.points.size(), plane.triangles), loop_refine);
  std::vector<Point> control = plane.points;
  const SimulationMesh mesh(levels, control, {0.02, {}}, no_limit);
  EXPECT_LE(levels.finest(), 2);
  // Loop's surface of the two triangles alone shrinks from their corners.
  EXPECT_NEAR(static_cast<double>(mesh.vertices()), 2 * 2 / std::sqrt(3.0) / (0.02 * 0.02), 1000);
}

TEST(SimulationMesh, RefusesWhatDoesNotFit) {
  const TriangleMesh shape = builtin_shape("builtin:sphere?n=642");
  Hierarchy levels(make_topology(shape.points.size(), shape.triangles), loop_refine);
  std::vector<Point> control = shape.points;
  EXPECT_THROW(SimulationMesh(levels, control, {1e-4, {}}, no_limit), Error);
}

/// On a finer mesh, the largest error of a smooth function that is known at the vertices.
double error_of_fields(double edge) {
  const Meshed coarse("builtin:sphere?n=642", edge);
  const std::vector<Point> points = coarse.points();
  const auto f = [](const Point& p) { return std::sin(3 * p[0]) + p[1] * p[2]; };
  std::vector<double> field;
  for (const Point& p : points) field.push_back(f(p));
  const TriangleMesh fine = builtin_shape("builtin:sphere?n=10242");
  const SurfaceWalk walk(*coarse.mesh.shared_topology(), points);
  const auto places = locate(make_topology(fine.points.size(), fine.triangles), fine.points, walk);
  const std::vector<double> values = fields_at(places, *coarse.mesh.shared_topology(), points, {field})[0];
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::pow(values[i] - f(fine.points[i]), 2);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(SimulationMesh, FieldsBetweenVerticesAreBetterThanLinear) {
  const double coarse = error_of_fields(0.12), fine = error_of_fields(0.06);
  EXPECT_LT(coarse, 3e-3);        // linear: 6e-3
  EXPECT_GT(coarse / fine, 4.5);  // linear: 4
}

}  // namespace
}  // namespace pelage
