#include "shape/remesh.h"

#include <gtest/gtest.h>

#include "shape/generators.h"
#include "support/mesh_facts.h"
#include "verify/triangulations.h"

namespace pelage {
namespace {

Point to_sphere(const Point& p) {
  const Eigen::Vector3d unit = testing::vec(p).normalized();
  return {unit.x(), unit.y(), unit.z()};
}

TEST(Remesh, MakesAnyTriangulationUniform) {
  using enum SphereTriangulation;
  for (SphereTriangulation kind : {uniform, graded, slivers})
    for (int n : {300, 3000}) {
      SCOPED_TRACE(n);
      const TriangleMesh mesh = remesh(unit_sphere(kind, 2000), static_cast<std::size_t>(n), to_sphere);
      const testing::MeshFacts facts = testing::mesh_facts(mesh);
      EXPECT_NEAR(static_cast<double>(mesh.points.size()), n, 0.1 * n);
      EXPECT_EQ(facts.euler, 2);
      EXPECT_TRUE(facts.closed);
      EXPECT_GT(facts.volume, 0);
      EXPECT_GT(facts.smallest_angle, 30);
      EXPECT_LT(facts.longest_edge / facts.shortest_edge, 2.5);
      for (const Point& p : mesh.points) EXPECT_NEAR(testing::vec(p).norm(), 1, 1e-14);
    }
}

TEST(Remesh, KeepsTheHoleOfARingThatIsThinnerThanItsEdges) {
  constexpr double radius = 0.1;
  auto on_ring = [&](const Point& p) -> Point {
    const Eigen::Vector3d core = Eigen::Vector3d(p[0], p[1], 0).normalized();
    const Eigen::Vector3d found = core + radius * (testing::vec(p) - core).normalized();
    return {found.x(), found.y(), found.z()};
  };
  TriangleMesh ring = builtin_shape("builtin:torus?n=2000");
  for (Point& p : ring.points) p = on_ring(p);
  for (std::size_t n : {20, 40, 80}) {
    const testing::MeshFacts facts = testing::mesh_facts(remesh(ring, n, on_ring));
    EXPECT_EQ(facts.euler, 0);
    EXPECT_TRUE(facts.closed);
  }
}

TEST(Triangulations, AreWhatTheirNamesSay) {
  const auto uniform = testing::mesh_facts(unit_sphere(SphereTriangulation::uniform, 4000));
  EXPECT_LT(uniform.longest_edge / uniform.shortest_edge, 1.5);
  const auto graded = testing::mesh_facts(unit_sphere(SphereTriangulation::graded, 4000));
  EXPECT_NEAR(graded.longest_edge / graded.shortest_edge, 10, 3);
  EXPECT_GT(graded.smallest_angle, 40);
  const auto slivers = testing::mesh_facts(unit_sphere(SphereTriangulation::slivers, 4000));
  EXPECT_LT(slivers.smallest_angle, 6);
  for (const auto& facts : {uniform, graded, slivers}) {
    EXPECT_EQ(facts.euler, 2);
    EXPECT_NEAR(facts.volume, 4.18879, 0.03);
  }
}

}  // namespace
}  // namespace pelage
