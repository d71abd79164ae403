#include "shape/crease_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "shape/creases.h"
#include "shape/generators.h"
#include "shape/mesh_place.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

struct Creased {
  TriangleMesh mesh;
  Topology topology;

  explicit Creased(const std::string& name)
      : mesh(builtin_shape(name)), topology(make_topology(mesh.points.size(), mesh.triangles)) {
    topology.creases = creases_above(40, topology, mesh.points);
  }
};

TEST(CreaseLines, ACubeHasTwelveBetweenItsCorners) {
  const Creased cube("builtin:cube?n=150");
  const CreaseLines lines(cube.topology, cube.mesh.points);
  std::set<Index> met;
  for (std::size_t h = 0; h < cube.topology.twin.size(); ++h) {
    const Index line = lines.line(static_cast<Index>(h));
    EXPECT_EQ(line != 0, cube.topology.sharp(static_cast<Index>(h)));
    EXPECT_EQ(line, -lines.line(cube.topology.twin[h]));
    if (line > 0) met.insert(line);
  }
  EXPECT_EQ(met.size(), 12);
  for (const Index line : met) {
    const CreaseLines::Place begin = lines.begin(line), end = lines.end(line);
    const Point &from = cube.mesh.points[cube.topology.origin(begin.halfedge)],
                &to = cube.mesh.points[cube.topology.target(end.halfedge)];
    const double s = length(difference(to, from));
    const auto point = [&](const CreaseLines::Place& p) {
      return point_at(cube.topology.triangles, cube.mesh.points, place_on(p.halfedge, p.along));
    };
    const auto along = [&](const CreaseLines::Place& p) { return length(difference(point(p), from)); };
    EXPECT_NEAR(along(lines.middle(begin, end)), s / 2, 1e-12);
    EXPECT_NEAR(along(lines.advance(begin, 0.3 * s)), 0.3 * s, 1e-12);
    EXPECT_NEAR(along(lines.advance(end, -0.3 * s)), 0.7 * s, 1e-12);
    EXPECT_NEAR(along(lines.advance(end, s)), s, 1e-12);
  }
}

/// The rim of a disc, a line without ends: around it and back.
TEST(CreaseLines, LinesMayBeClosed) {
  TriangleMesh mesh;  // two flat cones
  constexpr int n = 12;
  mesh.points = {{0, 0, 2}, {0, 0, -2}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / n;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
    mesh.triangles.push_back({0, 2 + i, 2 + (i + 1) % n});
    mesh.triangles.push_back({1, 2 + (i + 1) % n, 2 + i});
  }
  Topology t = make_topology(mesh.points.size(), mesh.triangles);
  t.creases = creases_above(40, t, mesh.points);
  const CreaseLines lines(t, mesh.points);
  const CreaseLines::Place begin = lines.begin(1);
  const double edge = length(difference(mesh.points[3], mesh.points[2]));
  const CreaseLines::Place around = lines.advance(begin, (n + 0.25) * edge), back = lines.advance(begin, -edge / 2);
  EXPECT_EQ(around.halfedge, begin.halfedge);
  EXPECT_NEAR(around.along, 0.25, 1e-9);
  EXPECT_NEAR(back.along, 0.5, 1e-9);
  EXPECT_EQ(t.target(back.halfedge), t.origin(begin.halfedge));
  const CreaseLines::Place past = lines.middle(back, lines.advance(begin, edge));  // over the beginning
  EXPECT_EQ(past.halfedge, begin.halfedge);
  EXPECT_NEAR(past.along, 0.25, 1e-9);
}

TEST(CreaseLines, PartASurfaceIntoRegions) {
  const auto count = [](const Topology& t) {
    const std::vector<Index> region = smooth_regions(t);
    return std::set<Index>(region.begin(), region.end()).size();
  };
  EXPECT_EQ(count(Creased("builtin:cube?n=150").topology), 6);
  EXPECT_EQ(count(Creased("builtin:sphere?n=162").topology), 1);
}

}  // namespace
}  // namespace pelage
