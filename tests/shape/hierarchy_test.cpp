#include "shape/hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discretise/sampling.h"
#include "pelage/error.h"
#include "shape/generators.h"
#include "shape/refine.h"

namespace pelage {
namespace {

struct Refined {
  Hierarchy hierarchy;
  std::vector<Point> points;
  explicit Refined(const std::string& spec, Hierarchy::Rule rule = loop_refine) : Refined(builtin_shape(spec), rule) {}
  Refined(const TriangleMesh& mesh, Hierarchy::Rule rule)
      : hierarchy(make_topology(mesh.points.size(), mesh.triangles), rule), points(mesh.points) {}
  const Topology& finest() const { return hierarchy.topology(hierarchy.finest()); }
  double edge() const { return prevailing_edge(finest().triangles, points); }
};

double area(const Topology& topology, const std::vector<Point>& control, int splits) {
  const Discretisation d = loop_discretisation(topology, {.regular_splits = splits, .irregular_splits = splits});
  double sum = 0;
  for (double w : quadrature_geometry(d, control).weight) sum += w;
  return sum;
}

TEST(Hierarchy, ReachesAnEdgeInAsFewLevelsAsItTakes) {
  for (const auto rule : {loop_refine, midpoint_refine}) {
    Refined mesh("builtin:animal?n=500", rule);
    const double edge = mesh.edge();
    refine_to_edge(mesh.hierarchy, mesh.points, edge, 1000000);
    EXPECT_EQ(mesh.hierarchy.finest(), 0);
    refine_to_edge(mesh.hierarchy, mesh.points, edge / 3, 1000000);
    EXPECT_EQ(mesh.hierarchy.finest(), 2);
    EXPECT_LE(mesh.edge(), edge / 3);
  }
}

TEST(Hierarchy, KeepsTheLimitSurface) {
  for (const char* spec : {"builtin:animal?n=500", "builtin:plane?n=100"}) {
    Refined mesh(spec);
    mesh.hierarchy.refine();
    mesh.hierarchy.refine();
    const std::vector<Point> fine = mesh.hierarchy.refined(mesh.points, 0, 2);
    EXPECT_NEAR(area(mesh.finest(), fine, 0) / area(mesh.hierarchy.topology(0), mesh.points, 2), 1, 1e-10) << spec;
    const auto before = limit_positions(loop_discretisation(mesh.hierarchy.topology(0)), mesh.points),
               after = limit_positions(loop_discretisation(mesh.finest()), fine);
    for (std::size_t i = 0; i < before.size(); ++i)  // the first vertices keep their numbers
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[i][k], before[i][k], 1e-13);
  }
}

TEST(Hierarchy, CopiesGoTheirOwnWayFromWhereTheyPart) {
  Refined mesh("builtin:sphere?n=162");
  mesh.hierarchy.refine();
  Hierarchy copy = mesh.hierarchy;
  copy.refine();
  EXPECT_EQ(mesh.hierarchy.finest(), 1);
  EXPECT_EQ(copy.finest(), 2);
  EXPECT_EQ(copy.shared_topology(1), mesh.hierarchy.shared_topology(1));
}

/// By the rule of midpoints both ways of refinement are the same, bit for bit, signs of zeros included.
TEST(Hierarchy, InterpolationIsRefinementByMidpoints) {
  Refined mesh("builtin:animal?n=500", midpoint_refine);
  for (Point& p : mesh.points)
    if (p[2] < 0) p[2] = -0.0;
  mesh.hierarchy.refine();
  mesh.hierarchy.refine();
  const std::vector<Point> a = mesh.hierarchy.refined(mesh.points, 0, 2),
                           b = mesh.hierarchy.interpolated(mesh.points, 0, 2);
  EXPECT_EQ(a, b);
  for (std::size_t v = 0; v < a.size(); ++v) EXPECT_EQ(std::signbit(a[v][2]), std::signbit(b[v][2]));
}

TEST(Hierarchy, RefusesWhatWouldNotFitIntoMemory) {
  Refined mesh("builtin:sphere?n=162");
  EXPECT_THROW(refine_to_edge(mesh.hierarchy, mesh.points, 1e-3, 10000), Error);
}

}  // namespace
}  // namespace pelage
