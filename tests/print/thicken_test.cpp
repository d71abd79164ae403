#include "print/thicken.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "print/perforate.h"
#include "print/self_meeting.h"
#include "shape/describe.h"
#include "shape/generators.h"
#include "shape/sample_meshes.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

constexpr double pi = std::numbers::pi;

/// 4/3 pi (1 - (1 - t)^3), but for the polyhedron, which differs by h^2.
TEST(Thicken, AHollowBallHasTheVolumeOfItsShell) {
  const double t = 0.2, shell = 4.0 / 3 * pi * (1 - std::pow(1 - t, 3));
  double before = 0;
  for (const int n : {642, 2562, 10242}) {
    const Wall wall = thickened(builtin_shape("builtin:sphere?n=" + std::to_string(n)), t, WallSide::inward);
    const testing::MeshFacts facts = testing::mesh_facts(wall.mesh);
    EXPECT_TRUE(facts.closed);
    EXPECT_EQ(facts.euler, 4);
    EXPECT_EQ(wall.thinner, 0U);
    EXPECT_DOUBLE_EQ(wall.thinnest, t);
    const double error = std::abs(facts.volume - shell);
    if (before > 0) {
      EXPECT_LT(error, before / 3.5);
    }
    before = error;
  }
  EXPECT_LT(before, 3e-3);
}

/// With k holes it is one surface of genus k - 1.
TEST(Thicken, HolesMakeHandles) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2562");
  const LevelFunction six = [&](const std::vector<CutPlace>& places) {
    std::vector<double> values;
    for (const CutPlace& e : places) {
      double nearest = -1;
      for (std::size_t d = 0; d < 3; ++d) {
        const double x = sphere.points[e.from][d], y = sphere.points[e.to][d];
        nearest = std::max(nearest, std::abs(x + e.part * (y - x)) - 0.9);
      }
      values.push_back(nearest);
    }
    return values;
  };
  const PerforatedSurface s = perforated(sphere.triangles, sphere.points, six);
  const TriangleMesh holed{s.at_vertices(sphere.points), s.triangles, {}};
  const Wall wall = thickened(holed, 0.1, WallSide::inward);
  const MeshReport report = describe(wall.mesh, {});
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.genus, 5);
  // Each hole cuts a cone out of the shell: its share of the sphere is 0.05.
  EXPECT_NEAR(report.volume, (1 - 6 * 0.05) * 4.0 / 3 * pi * (1 - std::pow(0.9, 3)), 0.01);
  EXPECT_TRUE(self_meetings(wall.mesh.triangles, wall.mesh.points).empty());
}

/// Faces of a cube move by the thickness, its corners by that along every axis.
TEST(Thicken, FlatFacesKeepTheirDistance) {
  const TriangleMesh cube = builtin_shape("builtin:cube?n=600");
  const testing::MeshFacts before = testing::mesh_facts(cube);
  const double side = std::cbrt(before.volume);
  const Wall wall = thickened(cube, side / 25, WallSide::inward);
  EXPECT_NEAR(testing::mesh_facts(wall.mesh).volume, before.volume * (1 - std::pow(0.92, 3)), 0.002 * before.volume);
  EXPECT_EQ(wall.thinner, 0U);
}

/// Also where triangles are smaller than the wall is thick: those beside an edge move aside.
TEST(Thicken, AtEdgesThereIsRoomForThickWalls) {
  const Wall wall = thickened(builtin_shape("builtin:cube?n=2000"), 0.15, WallSide::inward);
  const double side = std::cbrt(testing::mesh_facts(builtin_shape("builtin:cube?n=2000")).volume);
  EXPECT_LT(wall.thinner, 150U);  // near corners
  EXPECT_NEAR(testing::mesh_facts(wall.mesh).volume, std::pow(side, 3) - std::pow(side - 0.3, 3), 0.02);
}

TEST(Thicken, ASheetBecomesASlabAroundIt) {
  const TriangleMesh sheet = test::sheet(4);
  const testing::MeshFacts flat = testing::mesh_facts(sheet);
  const Wall wall = thickened(sheet, 0.5, WallSide::both);
  const testing::MeshFacts slab = testing::mesh_facts(wall.mesh);
  EXPECT_TRUE(slab.closed);
  EXPECT_EQ(slab.euler, 2);
  EXPECT_NEAR(slab.volume, 0.5 * flat.area, 1e-12);
  for (std::size_t v = 0; v < sheet.points.size(); ++v)
    EXPECT_NEAR(std::abs(wall.mesh.points[v][2] - sheet.points[v][2]), 0.25, 1e-12);
}

/// More than the radius of a ball, or of a tube in it, cannot be had: thinner, but never through itself.
TEST(Thicken, WallsThatHaveNoRoomAreThinner) {
  for (const char* shape : {"builtin:sphere?n=642", "builtin:torus?n=576", "builtin:animal?n=1500"}) {
    const TriangleMesh mesh = builtin_shape(shape);
    const Wall wall = thickened(mesh, 1.5, WallSide::inward);
    const testing::MeshFacts facts = testing::mesh_facts(wall.mesh);
    EXPECT_TRUE(facts.closed) << shape;
    EXPECT_GT(wall.thinner, 0U) << shape;
    EXPECT_GT(wall.thinnest, 0) << shape;
    EXPECT_GT(facts.volume, 0) << shape;
    EXPECT_LT(facts.volume, testing::mesh_facts(mesh).volume) << shape;
    EXPECT_TRUE(self_meetings(wall.mesh.triangles, wall.mesh.points).empty()) << shape;
  }
}

TEST(Thicken, BothSidesHaveTheAttributes) {
  TriangleMesh sheet = test::sheet(3);
  Attribute color{"color", 3, Domain::vertex, {}}, uv{"uv", 2, Domain::corner, {}}, part{"part", 1, Domain::face, {}};
  for (std::size_t v = 0; v < sheet.points.size(); ++v)
    for (int k = 0; k < 3; ++k) color.values.push_back(static_cast<double>(v) / 100);
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    part.values.push_back(static_cast<double>(t));
    for (const std::int32_t v : sheet.triangles[t])
      for (const double x : {sheet.points[v][0], sheet.points[v][1]}) uv.values.push_back(x);
  }
  for (const Attribute& a : {color, uv, part}) sheet.set(a);
  const Wall wall = thickened(sheet, 1e-9, WallSide::both);
  const std::size_t n = sheet.points.size();
  for (std::size_t t = 0; t < wall.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = static_cast<std::size_t>(wall.mesh.triangles[t][k]) % n;
      EXPECT_NEAR(wall.mesh.find("uv")->values[2 * (3 * t + k)], sheet.points[v][0], 1e-6);
      EXPECT_EQ(wall.mesh.find("color")->values[3 * static_cast<std::size_t>(wall.mesh.triangles[t][k])],
                color.values[3 * v]);
    }
  EXPECT_EQ(wall.mesh.find("part")->values.size(), wall.mesh.triangles.size());
}

}  // namespace
}  // namespace pelage
