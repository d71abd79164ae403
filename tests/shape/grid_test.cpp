// Grids as shapes: built-in ones, their meshes, and what is refused.

#include "shape/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pelage/error.h"
#include "shape/builtin_grids.h"
#include "shape/topology.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

std::string refusal(const std::string& spec) {
  try {
    check_builtin_grid(spec);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    return error.what();
  }
  return "";
}

TEST(Grid, BuiltInOnesAreWhatTheirNamesSay) {
  const Grid line = builtin_grid("builtin:line"), tile = builtin_grid("builtin:tile?n=64x32"),
             sheet = builtin_grid("builtin:sheet?n=20&periodic=y"), box = builtin_grid("builtin:box?n=8x9x10");
  EXPECT_EQ(line.dimension(), 1);
  EXPECT_EQ(line.nodes(), 60U);
  EXPECT_EQ(tile.dimension(), 2);
  EXPECT_TRUE(tile.periodic[0] && tile.periodic[1] && !tile.periodic[2]);
  EXPECT_EQ(tile.cells(0), 64);
  EXPECT_EQ(box.nodes(), 720U);
  EXPECT_TRUE(!sheet.periodic[0] && sheet.periodic[1]);
  EXPECT_EQ(sheet.cells(0), 19);
  EXPECT_EQ(tile.point(tile.node(3, 5, 0)), (Point{3.0 / 64, 5.0 / 64, 0}));
  EXPECT_DOUBLE_EQ(mean_edge(tile), 1.0 / 64);
  EXPECT_EQ(period_of(tile), (Point{1, 0.5, 0}));
  for (const Grid& grid : {line, tile, sheet, box}) EXPECT_NO_THROW(require_sound(grid));
}

TEST(Grid, WhatCannotBeIsRefusedByName) {
  EXPECT_NE(refusal("builtin:tile?n=2").find("3 nodes along a periodic axis"), std::string::npos);
  EXPECT_NE(refusal("builtin:tile?n=20x").find("one whole number or one per axis"), std::string::npos);
  EXPECT_NE(refusal("builtin:box?n=20x20").find("one whole number or one per axis"), std::string::npos);
  EXPECT_NE(refusal("builtin:tile?m=20").find("unknown parameter"), std::string::npos);
  EXPECT_NE(refusal("builtin:line?periodic=y").find("must be some of x"), std::string::npos);
  EXPECT_NE(refusal("builtin:tile?n=100000").find("too much memory"), std::string::npos);
  EXPECT_NE(refusal("builtin:box?n=999999999").find("too much memory"), std::string::npos);
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](int k) { return mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += length(cross(difference(at(1), at(0)), difference(at(2), at(0)))) / 2;
  }
  return sum;
}

/// Its cells behind the last nodes are not shown where they would reach across.
TEST(Grid, TheMeshOfATileEndsAtItsLastNodes) {
  const TriangleMesh mesh = mesh_of(builtin_grid("builtin:tile?n=16"));
  EXPECT_EQ(mesh.triangles.size(), 2U * 15 * 15);
  EXPECT_NEAR(area(mesh), std::pow(15.0 / 16, 2), 1e-12);
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](int k) { return mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    EXPECT_GT(cross(difference(at(1), at(0)), difference(at(2), at(0)))[2], 0);
  }
}

/// A ring whose first axis goes around.
TEST(Grid, ARingIsClosed) {
  Grid ring;
  ring.count = {24, 5, 1};
  ring.periodic = {true, false, false};
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 24; ++i) {
      const double angle = 2 * std::numbers::pi * i / 24, r = 1 + 0.25 * j;
      ring.points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
  const TriangleMesh mesh = mesh_of(ring);
  EXPECT_EQ(mesh.triangles.size(), 2U * 24 * 4);
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  std::size_t open = 0;
  for (const Index twin : topology.twin) open += twin < 0;
  EXPECT_EQ(open, 48U);
}

TEST(Grid, AnImageOfAsManyTexelsFallsOnItsNodes) {
  const Attribute uv = uv_of(builtin_grid("builtin:sheet?n=4x2"));
  EXPECT_DOUBLE_EQ(uv.values[0], 0.125);
  EXPECT_DOUBLE_EQ(uv.values[1], 0.25);
  EXPECT_DOUBLE_EQ(uv.values[14], 0.875);
  EXPECT_DOUBLE_EQ(uv.values[15], 0.75);
}

TEST(Grid, UnsoundOnesAreRefused) {
  const Grid good = builtin_grid("builtin:sheet?n=4");
  const auto refused = [](Grid grid, const std::string& why) {
    try {
      require_sound(grid);
    } catch (const Error& error) {
      return std::string(error.what()).find(why) != std::string::npos;
    }
    return false;
  };
  Grid grid = good;
  grid.points.resize(3);
  EXPECT_TRUE(refused(grid, "3 points for 16 nodes"));
  grid = good;
  grid.spacing[1] = 0;
  EXPECT_TRUE(refused(grid, "spacing"));
  grid = good;
  grid.set({"a", 1, Domain::vertex, {1, 2}});
  EXPECT_TRUE(refused(grid, "attribute \"a\""));
  grid = good;
  grid.count = {4, 1, 4};
  EXPECT_TRUE(refused(grid, "third axis"));
  grid = good;
  grid.count = {50000, 50000, 1};
  EXPECT_TRUE(refused(grid, "more nodes than can be counted"));
}

}  // namespace
}  // namespace pelage
