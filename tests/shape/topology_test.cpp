#include "shape/topology.h"

#include <gtest/gtest.h>

#include <set>

#include "pelage/error.h"
#include "sample_meshes.h"
#include "shape/generators.h"

namespace pelage {
namespace {

Topology of(const TriangleMesh& mesh) { return make_topology(mesh.points.size(), mesh.triangles); }

void expect_consistent(const Topology& t) {
  std::set<Index> edges;
  for (Index h = 0; h < static_cast<Index>(t.twin.size()); ++h) {
    EXPECT_EQ(next_halfedge(previous_halfedge(h)), h);
    edges.insert(t.edge[h]);
    if (t.twin[h] < 0) continue;
    EXPECT_EQ(t.twin[t.twin[h]], h);
    EXPECT_EQ(t.edge[t.twin[h]], t.edge[h]);
    EXPECT_EQ(t.origin(h), t.target(t.twin[h]));
  }
  EXPECT_EQ(static_cast<Index>(edges.size()), t.edge_count);
  EXPECT_EQ(*edges.rbegin(), t.edge_count - 1);
}

/// Consecutive neighbours span a triangle with the vertex, in this orientation.
void expect_rings(const Topology& t) {
  std::set<std::array<Index, 3>> corners;
  for (const Triangle& f : t.triangles)
    for (std::size_t k = 0; k < 3; ++k) corners.insert({f[k], f[(k + 1) % 3], f[(k + 2) % 3]});
  std::vector<Index> ring;
  std::size_t met = 0;
  for (Index v = 0; v < t.vertex_count; ++v) {
    t.one_ring(v, ring);
    const std::size_t triangles = ring.size() - (t.on_boundary(v) ? 1 : 0);
    for (std::size_t i = 0; i < triangles; ++i)
      EXPECT_TRUE(corners.count({v, ring[i], ring[(i + 1) % ring.size()]})) << "vertex " << v;
    met += triangles;
  }
  EXPECT_EQ(met, 3 * t.triangles.size());
}

TEST(Topology, HalfedgesAndRings) {
  for (const TriangleMesh& mesh :
       {test::tetrahedron(), test::torus(7), test::sheet(3), builtin_shape("builtin:sphere?n=162")}) {
    const Topology t = of(mesh);
    expect_consistent(t);
    expect_rings(t);
  }
}

TEST(Topology, EulerCharacteristic) {
  auto euler = [](const Topology& t) { return t.vertex_count - t.edge_count + static_cast<Index>(t.triangles.size()); };
  EXPECT_EQ(euler(of(test::cube())), 2);
  EXPECT_EQ(euler(of(test::torus())), 0);
  EXPECT_EQ(euler(of(test::sheet())), 1);
}

TEST(Topology, OnlyTheRimIsBoundary) {
  const TriangleMesh sheet = test::sheet(4);
  const Topology t = of(sheet);
  for (Index v = 0; v < t.vertex_count; ++v) {
    const Point& p = sheet.points[v];
    EXPECT_EQ(t.on_boundary(v), p[0] == 0 || p[0] == 4 || p[1] == 0 || p[1] == 4);
  }
}

TEST(Topology, LargestValence) {
  EXPECT_EQ(max_valence(of(test::torus())), 6);
  EXPECT_EQ(max_valence(of(test::tetrahedron())), 3);
  EXPECT_EQ(max_valence(make_topology(3, {{0, 1, 2}})), 2);
}

TEST(Topology, IsolatedVerticesHaveEmptyRings) {
  const Topology t = make_topology(5, {{0, 1, 2}});
  std::vector<Index> ring = {7};
  t.one_ring(4, ring);
  EXPECT_TRUE(ring.empty());
  EXPECT_TRUE(t.on_boundary(4));
}

TEST(Topology, RefusesWhatIsNotManifold) {
  EXPECT_THROW(make_topology(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), Error);  // three triangles at an edge
  EXPECT_THROW(make_topology(4, {{0, 1, 2}, {0, 1, 3}}), Error);             // turned against each other
  EXPECT_THROW(make_topology(5, {{0, 1, 2}, {0, 3, 4}}), Error);             // joined at a vertex only
}

}  // namespace
}  // namespace pelage
