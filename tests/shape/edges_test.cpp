#include "shape/edges.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "shape/sample_meshes.h"

namespace pelage {
namespace {

TEST(EdgeTable, AgreesWithAMap) {
  TriangleMesh mesh = test::torus(7);
  mesh.triangles.push_back({3, 20, 11});
  mesh.triangles.push_back({20, 3, 12});
  std::map<std::pair<int, int>, std::vector<HalfEdge>> expected;
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(3 * mesh.triangles.size()); ++h)
    expected[std::minmax(tail(mesh.triangles, h), tip(mesh.triangles, h))].push_back(h);
  const EdgeTable edges(mesh.triangles, mesh.points.size());
  ASSERT_EQ(edges.size(), expected.size());
  std::size_t e = 0;
  for (const auto& [key, half_edges] : expected) {
    EXPECT_EQ(std::vector<HalfEdge>(edges[e].begin(), edges[e].end()), half_edges);
    ++e;
  }
}

TEST(EdgeTable, EmptyMesh) { EXPECT_EQ(EdgeTable({}, 5).size(), 0u); }

}  // namespace
}  // namespace pelage
