#include "shape/refine.h"

#include <gtest/gtest.h>

#include "discretise/sampling.h"
#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

RefinedMesh mesh_of(const std::string& spec) {
  TriangleMesh mesh = builtin_shape(spec);
  return {make_topology(mesh.points.size(), mesh.triangles), mesh.points, 0};
}

double area(const RefinedMesh& mesh, int splits) {
  const Discretisation d = loop_discretisation(mesh.topology, {.regular_splits = splits, .irregular_splits = splits});
  double sum = 0;
  for (double w : quadrature_geometry(d, mesh.control).weight) sum += w;
  return sum;
}

TEST(PrevailingEdge, IsTheEdgeOfAnEvenMesh) {
  // Two halves of unit squares: the diagonal.
  EXPECT_NEAR(prevailing_edge({{0, 1, 2}, {0, 2, 3}}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), std::sqrt(2.0),
              1e-15);
}

/// One large triangle of two percent of the area does not decide.
TEST(PrevailingEdge, IgnoresASmallPartOfTheArea) {
  const TriangleMesh plane = builtin_shape("builtin:plane?n=2500");
  std::vector<Point> points = plane.points;
  std::vector<Triangle> triangles = plane.triangles;
  const double before = prevailing_edge(triangles, points);
  const auto n = static_cast<Index>(points.size());
  points.insert(points.end(), {{0, 0, 1}, {0.2, 0, 1}, {0, 0.2, 1}});
  triangles.push_back({n, n + 1, n + 2});
  EXPECT_NEAR(prevailing_edge(triangles, points), before, 1e-12);
}

TEST(RefineToEdge, ReachesTheEdgeInAsFewLevelsAsItTakes) {
  const RefinedMesh coarse = mesh_of("builtin:animal?n=500");
  const double edge = prevailing_edge(coarse.topology.triangles, coarse.control);
  for (bool loop : {true, false}) {
    const RefinedMesh fine = refine_to_edge(coarse, edge / 3, loop, 1000000);
    EXPECT_EQ(fine.levels, 2);
    EXPECT_LE(prevailing_edge(fine.topology.triangles, fine.control), edge / 3);
  }
  EXPECT_EQ(refine_to_edge(coarse, edge, true, 1000000).levels, 0);
}

TEST(RefineToEdge, KeepsTheLimitSurface) {
  for (const char* spec : {"builtin:animal?n=500", "builtin:plane?n=100"}) {
    const RefinedMesh coarse = mesh_of(spec);
    const RefinedMesh fine = refine_once(refine_once(coarse, true), true);
    EXPECT_NEAR(area(fine, 0) / area(coarse, 2), 1, 1e-10) << spec;
    const auto before = limit_positions(loop_discretisation(coarse.topology), coarse.control),
               after = limit_positions(loop_discretisation(fine.topology), fine.control);
    for (std::size_t i = 0; i < before.size(); ++i)  // the first vertices keep their numbers
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[i][k], before[i][k], 1e-13);
  }
}

TEST(RefineToEdge, RefusesWhatWouldNotFitIntoMemory) {
  EXPECT_THROW(refine_to_edge(mesh_of("builtin:sphere?n=162"), 1e-3, true, 10000), Error);
}

}  // namespace
}  // namespace pelage
