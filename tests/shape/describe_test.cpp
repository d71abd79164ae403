#include "shape/describe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shape/sample_meshes.h"

namespace pelage {
namespace {

TEST(Describe, Tetrahedron) {
  const MeshReport r = describe(test::tetrahedron());
  EXPECT_EQ(r.vertices, 4u);
  EXPECT_EQ(r.edges, 6u);
  EXPECT_EQ(r.faces, 4u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.euler_characteristic, 2);
  EXPECT_EQ(r.genus, 0);
  EXPECT_TRUE(r.closed);
  EXPECT_EQ(r.boundary_loops, 0u);
  EXPECT_EQ(r.valences, (std::map<int, std::size_t>{{3, 4}}));
  EXPECT_NEAR(r.edge_length.min, std::sqrt(8), 1e-14);
  EXPECT_NEAR(r.edge_length.mean, std::sqrt(8), 1e-14);
  EXPECT_NEAR(r.angle.min, 60, 1e-12);
  EXPECT_NEAR(r.angle.max, 60, 1e-12);
  EXPECT_NEAR(r.area, 8 * std::sqrt(3), 1e-13);
  EXPECT_NEAR(r.volume, 8.0 / 3, 1e-14);
  EXPECT_NEAR(r.diagonal, 2 * std::sqrt(3), 1e-14);
  EXPECT_TRUE(r.findings.empty());
}

TEST(Describe, GenusAndLoopsOfSeveralComponents) {
  TriangleMesh mesh = test::together(test::together(test::torus(), test::cube({9, 9, 9})), test::sheet());
  mesh.triangles.erase(mesh.triangles.begin());  // a hole in the torus
  const MeshReport r = describe(mesh, {});
  EXPECT_EQ(r.components, 3u);
  EXPECT_EQ(r.boundary_loops, 2u);
  EXPECT_EQ(r.boundary_edges, 3u + 16u);
  EXPECT_EQ(r.euler_characteristic, -1 + 2 + 1);
  EXPECT_EQ(r.genus, 1);
  EXPECT_FALSE(r.closed);
  EXPECT_NEAR(r.volume, 1, 1e-12);
}

TEST(Describe, SheetAnglesMeanAndAttributes) {
  TriangleMesh mesh = test::sheet(3);
  mesh.attributes = {{"uv", 2, Domain::corner, std::vector<double>(2 * 3 * 18)}};
  const MeshReport r = describe(mesh, {});
  EXPECT_NEAR(r.angle.min, 45, 1e-12);
  EXPECT_NEAR(r.angle.mean, 60, 1e-12);
  EXPECT_NEAR(r.angle.max, 90, 1e-12);
  EXPECT_NEAR(r.area, 9, 1e-13);
  EXPECT_NEAR(r.edge_length.max, std::sqrt(2), 1e-14);
  EXPECT_EQ(r.attributes, std::vector<std::string>{"uv (2 per corner)"});
}

TEST(Describe, SaysWhatWouldBeRepaired) {
  TriangleMesh mesh = test::cube();
  mesh.triangles.push_back(mesh.triangles[3]);
  EXPECT_EQ(describe(mesh).findings.at(0).kind, "duplicate-faces");
}

}  // namespace
}  // namespace pelage
