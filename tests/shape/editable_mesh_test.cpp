#include "shape/editable_mesh.h"

#include <gtest/gtest.h>

#include "shape/generators.h"
#include "support/mesh_facts.h"

namespace pelage {
namespace {

/// Everything that an editable mesh keeps must be what its triangles alone say.
void expect_consistent(EditableMesh mesh) {
  mesh.pack();
  const Topology own = mesh.topology();
  const Topology truth = make_topology(static_cast<std::size_t>(mesh.vertex_count()), own.triangles);
  ASSERT_EQ(own.twin, truth.twin);
  ASSERT_EQ(own.edge, truth.edge);
  ASSERT_EQ(own.edge_count, truth.edge_count);
  ASSERT_EQ(own.outgoing, truth.outgoing);
  ASSERT_EQ(mesh.live_faces(), static_cast<Index>(truth.triangles.size()));
  ASSERT_EQ(mesh.live_vertices(), truth.vertex_count);
  std::vector<Index> ring;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) ASSERT_EQ(mesh.twin(h), truth.twin[static_cast<std::size_t>(h)]);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    truth.one_ring(v, ring);
    ASSERT_EQ(mesh.valence(v), static_cast<Index>(ring.size()));
    ASSERT_EQ(mesh.on_boundary(v), truth.on_boundary(v));
    std::vector<Index> met;
    mesh.around(v, [&](Index n) { met.push_back(n); });
    std::sort(met.begin(), met.end());
    std::sort(ring.begin(), ring.end());
    ASSERT_EQ(met, ring);
    ASSERT_EQ(mesh.origin(mesh.outgoing(v)), v);
  }
}

Index euler(const EditableMesh& mesh) {
  Index edges = 0;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) edges += mesh.alive(h) && mesh.twin(h) < h;
  return mesh.live_vertices() - edges + mesh.live_faces();
}

TEST(EditableMesh, StaysAManifoldOfTheSameFormUnderRandomEdits) {
  for (const char* shape : {"builtin:sphere?n=200", "builtin:torus?n=200", "builtin:plane?n=100"}) {
    SCOPED_TRACE(shape);
    const TriangleMesh start = builtin_shape(shape);
    EditableMesh mesh(make_topology(start.points.size(), start.triangles));
    const Index form = euler(mesh);
    std::uint64_t state = 1;
    const auto random = [&](Index n) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      return static_cast<Index>((state >> 33) % static_cast<std::uint64_t>(n));
    };
    for (int i = 0; i < 3000; ++i) {
      const Index h = random(mesh.halfedge_count());
      if (!mesh.alive(h)) continue;
      const Index kind = random(7);
      if (kind == 0) mesh.split(h);
      if (kind > 0 && kind < 4 && mesh.may_flip(h)) mesh.flip(h);
      if (kind >= 4 && mesh.may_collapse(h)) mesh.collapse(h);
      if (i % 50 == 0) expect_consistent(mesh);
      if (HasFatalFailure()) FAIL() << "after edit " << i;
    }
    EXPECT_EQ(euler(mesh), form);
    expect_consistent(mesh);
  }
}

TEST(EditableMesh, EndsInTheSmallestMeshesThatHaveTheForm) {
  const TriangleMesh start = builtin_shape("builtin:sphere?n=200");
  EditableMesh mesh(make_topology(start.points.size(), start.triangles));
  for (int pass = 0; pass < 20; ++pass)
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
      if (mesh.alive(h) && mesh.may_collapse(h)) mesh.collapse(h);
  expect_consistent(mesh);
  EXPECT_EQ(mesh.live_vertices(), 4);
}

TEST(EditableMesh, PackingPutsNeighboursTogether) {
  const TriangleMesh start = builtin_shape("builtin:sphere?n=5000");
  EditableMesh mesh(make_topology(start.points.size(), start.triangles));
  mesh.pack();
  Index widest = 0, last = 0;
  for (Index h = 0; h < mesh.halfedge_count(); ++h)
    widest = std::max(widest, std::abs(mesh.origin(h) - mesh.target(h)));
  EXPECT_LT(widest, 500);  // two rings
  for (const Triangle& t : mesh.topology().triangles) {
    const Index smallest = std::min({t[0], t[1], t[2]});
    EXPECT_GE(smallest, last);
    last = smallest;
  }
}

}  // namespace
}  // namespace pelage
