// Filled surfaces: angles, volumes, what is inside, and what is refused.

#include "solid/fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/box.h"
#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/closest_point.h"
#include "shape/edges.h"
#include "shape/generators.h"
#include "shape/tet_mesh.h"
#include "shape/tet_quality.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

using std::numbers::pi;
using testing::mesh_facts;

constexpr std::size_t many = 4'000'000;

/// Both, moved by `shift`; turned inside out on demand.
TriangleMesh together(TriangleMesh mesh, const TriangleMesh& other, double scale, const Point& shift) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Point& p : other.points)
    mesh.points.push_back({scale * p[0] + shift[0], scale * p[1] + shift[1], scale * p[2] + shift[2]});
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

void expect_sound(const TetMesh& volume) {
  for (const Tetrahedron& t : volume.tets) {
    const auto p = [&](std::size_t c) { return volume.points[static_cast<std::size_t>(t[c])]; };
    ASSERT_GT(signed_volume(p(0), p(1), p(2), p(3)), 0);
  }
  const auto [least, most] = dihedral_angles(volume);
  EXPECT_GE(least, 10);
  EXPECT_LE(most, 165);
}

TEST(Fill, BuiltInShapesHaveGoodAnglesTheirVolumeAndTheirTopology) {
  const std::pair<const char*, double> shapes[] = {{"builtin:sphere", 30},
                                                   {"builtin:cube", 25},
                                                   {"builtin:animal", 50},
                                                   {"builtin:torus", 32},
                                                   {"builtin:knot", 62}};
  for (const auto& [name, edges] : shapes) {
    const TriangleMesh shape = builtin_shape(name);
    const Filling filling = fill(shape, box_of(shape.points).diagonal() / edges, many);
    expect_sound(filling.volume);
    const auto expected = mesh_facts(shape);
    const auto skin = mesh_facts(mesh_of(filling.volume));
    EXPECT_NEAR(volume_of(filling.volume) / expected.volume, 1, 0.01) << name;
    EXPECT_LT(std::abs(filling.lost), 0.012) << name;
    EXPECT_TRUE(skin.closed) << name;
    const auto inner = static_cast<int>(std::ranges::count(skin.valences, 0));
    EXPECT_EQ(skin.euler - inner, expected.euler) << name;
  }
}

TEST(Fill, NodesOfTheSkinLieOnTheSurface) {
  const TriangleMesh shape = builtin_shape("builtin:animal");
  const double edge = box_of(shape.points).diagonal() / 50;
  const TetMesh volume = fill(shape, edge, many).volume;
  const auto skin = mesh_facts(mesh_of(volume));
  const DistanceTree surface(shape);
  for (std::size_t v = 0; v < volume.nodes(); ++v)
    if (skin.valences[v] > 0) {
      EXPECT_LT(surface.distance(volume.points[v]), 1e-4 * edge);
    }
}

TEST(Fill, TheErrorOfTheVolumeOfABallIsOfSecondOrder) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=40000");
  const auto error = [&](double edge) { return 4 * pi / 3 - volume_of(fill(sphere, edge, many).volume); };
  EXPECT_GT(error(0.1), 0);
  EXPECT_NEAR(error(0.2) / error(0.1), 4, 0.4);
}

TEST(Fill, ShellsInsideAreCavitiesHoweverTheyAreTurned) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2000");
  const double whole = mesh_facts(sphere).volume;
  const TriangleMesh hollow = together(sphere, sphere, 0.5, {0.1, 0, 0});
  const TriangleMesh inverted = together(sphere, turned(sphere), 0.5, {0.1, 0, 0});
  const TriangleMesh with_core = together(hollow, sphere, 0.25, {0.1, 0, 0});
  for (const TriangleMesh& mesh : {hollow, inverted})
    EXPECT_NEAR(volume_of(fill(mesh, 0.08, many).volume), whole * (1 - 0.125), 0.01 * whole);
  EXPECT_NEAR(volume_of(fill(with_core, 0.08, many).volume), whole * (1 - 0.125 + 0.015625), 0.01 * whole);
}

TEST(Fill, PartsThatOverlapAreOne) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=2000");
  const Filling both = fill(together(sphere, sphere, 1, {1, 0, 0}), 0.08, many);
  expect_sound(both.volume);
  const double lens = pi * (4 + 1) / 12;  // of two balls of radius 1 at the distance 1
  EXPECT_NEAR(volume_of(both.volume), 8 * pi / 3 - lens, 0.1);
  const auto skin = mesh_facts(mesh_of(both.volume));
  EXPECT_EQ(skin.euler - std::ranges::count(skin.valences, 0), 2);  // without walls inside
}

/// How many edges have other than two triangles.
std::size_t bad_edges(const std::vector<Triangle>& triangles, std::size_t vertices) {
  const EdgeTable edges(triangles, vertices);
  std::size_t bad = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) bad += edges[e].size() != 2 ? 1 : 0;
  return bad;
}

/// Boxes that nearly touch, at an edge or a face, meet in the same tetrahedra.
TEST(Fill, SkinsAreManifoldsWherePartsNearlyTouch) {
  const TriangleMesh cube = builtin_shape("builtin:cube");
  const double size = box_of(cube.points).diagonal() / std::sqrt(3);
  for (const Point& way : {Point{1.01, 1.01, 0.3}, {1.02, 0.4, 0.3}, {1.03, 1.02, 1.01}, {1.005, 0.7, 1.03}})
    for (const double edges : {9, 26}) {
      const TriangleMesh both = together(cube, cube, 1, {size * way[0], size * way[1], size * way[2]});
      const Filling filling = fill(both, size / edges, many);
      expect_sound(filling.volume);
      EXPECT_EQ(bad_edges(mesh_of(filling.volume).triangles, filling.volume.nodes()), 0U) << way[0] << " " << edges;
      EXPECT_LT(std::abs(filling.lost), 0.06);
    }
}

/// Thin walls: with a shorter edge more of them is there.
TEST(Fill, TakesShorterEdgesForTheVolume) {
  TriangleMesh plate = builtin_shape("builtin:cube");
  for (Point& p : plate.points) p[2] *= 0.06;
  const double edge = box_of(plate.points).diagonal() / 15;
  EXPECT_GT(fill(plate, edge, many).lost, 0.02);
  const Filling filling = fill_within(plate, edge, 0.02, many);
  EXPECT_LE(filling.lost, 0.02);
  EXPECT_LT(filling.edge, edge);
  EXPECT_GE(filling.edge, edge / 2);
  EXPECT_NEAR(volume_of(filling.volume) / mesh_facts(plate).volume, 1 - filling.lost, 1e-9);
  EXPECT_EQ(fill_within(plate, edge, 1, many).edge, edge);
}

TEST(Fill, PlacesUnitsAndThreadsDoNotMatter) {
  const TriangleMesh shape = builtin_shape("builtin:animal?n=1000");
  const double edge = box_of(shape.points).diagonal() / 30;
  const TetMesh expected = fill(shape, edge, many).volume;
  {
    const ThreadLimit one(1);
    const TetMesh again = fill(shape, edge, many).volume;
    EXPECT_EQ(again.points, expected.points);
    EXPECT_EQ(again.tets, expected.tets);
  }
  TriangleMesh moved = shape;
  for (Point& p : moved.points) p = {1024 * p[0] + 4096, 1024 * p[1], 1024 * p[2] - 4096};
  EXPECT_EQ(fill(moved, 1024 * edge, many).volume.tets, expected.tets);
}

TEST(Fill, NodesHaveTheValuesOfTheNearestPlace) {
  TriangleMesh cube = builtin_shape("builtin:cube?n=2000");
  Attribute height{"height", 1, Domain::vertex, {}};
  for (const Point& p : cube.points) height.values.push_back(p[2]);
  cube.set(height);
  const TetMesh volume = fill(cube, 0.1, many).volume;
  const Attribute* carried = volume.find("height");
  ASSERT_TRUE(carried);
  ASSERT_EQ(carried->values.size(), volume.nodes());
  const auto skin = mesh_facts(mesh_of(volume));
  for (std::size_t v = 0; v < volume.nodes(); ++v) {
    const Point& p = volume.points[v];
    if (skin.valences[v] > 0) {
      EXPECT_NEAR(carried->values[v], p[2], 1e-4);
    }
    // Below the middle of the top that is nearest.
    if (p[2] > 0 && std::max(std::abs(p[0]), std::abs(p[1])) < p[2] - 1e-9) {
      EXPECT_NEAR(carried->values[v], 0.5, 1e-6);
    }
  }
}

std::string message(const TriangleMesh& mesh, double edge, std::size_t most) {
  try {
    fill(mesh, edge, most);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "nothing";
}

TEST(Fill, RefusesWhatItCannotFill) {
  TriangleMesh sphere = builtin_shape("builtin:sphere?n=500");
  EXPECT_NE(message(sphere, 0.01, 1000).find("50 million tetrahedra, more than the 0.001 million"), std::string::npos)
      << message(sphere, 0.01, 1000);
  EXPECT_NE(message(sphere, 10, many).find("too long to fill"), std::string::npos);
  sphere.triangles.pop_back();
  EXPECT_NE(message(sphere, 0.1, many).find("the shape is open, and has no inside to fill: 3 edges with one face"),
            std::string::npos);
}

}  // namespace
}  // namespace pelage
