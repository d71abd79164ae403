#include "io/ply_writer.h"

#include "base/srgb.h"
#include "io/ply_reader.h"
#include "io/written_meshes.h"

namespace pelage {
namespace {

TriangleMesh round_trip(const TriangleMesh& mesh) { return test::raw_mesh(read_ply(encode_ply(mesh), "a.ply")); }

void expect_same(const TriangleMesh& mesh) {
  const TriangleMesh back = round_trip(mesh);
  EXPECT_TRUE(test::same_places(mesh, back));
  EXPECT_EQ(test::corner_difference(mesh, mesh.find("a"), back, back.find("a")), 0);
  EXPECT_EQ(test::corner_difference(mesh, mesh.find("level 2"), back, back.find("level_2")), 0);
  // 8 bits of sRGB: half a step is largest where the curve is steepest, at white.
  EXPECT_LT(test::corner_difference(mesh, mesh.find("color"), back, back.find("color")), 2.3 / 255 / 2);
}

TEST(PlyWriter, RoundTripClosed) { expect_same(test::closed_mesh()); }

TEST(PlyWriter, RoundTripSeams) {
  const TriangleMesh mesh = test::seamed_mesh(), back = round_trip(mesh);
  expect_same(mesh);
  EXPECT_EQ(back.points.size(), mesh.points.size() + 5);  // the middle line of 5 vertices is doubled
  EXPECT_EQ(test::corner_difference(mesh, mesh.find("uv"), back, back.find("uv")), 0);
}

TEST(PlyWriter, DoublesOnlyWhereFloatsWouldLose) {
  TriangleMesh mesh = test::closed_mesh();
  EXPECT_NE(encode_ply(mesh).find("property float x\n"), std::string::npos);
  mesh.points[17][1] += 1e-9;  // no float
  EXPECT_NE(encode_ply(mesh).find("property float x\n"), std::string::npos);
  for (Point& p : mesh.points) p[0] += 123456.1;  // map coordinates
  EXPECT_NE(encode_ply(mesh).find("property double x\n"), std::string::npos);
  EXPECT_TRUE(test::same_places(mesh, round_trip(mesh)));
}

TEST(PlyWriter, NamesThatMeanSomethingElseAreMarked) {
  TriangleMesh mesh = test::tetrahedron();
  for (const char* name : {"u", "v", "x", "red", "a b", "a-b", "a_b"})
    mesh.attributes.push_back({name, 1, Domain::vertex, {1, 2, 3, 4}});
  mesh.attributes.push_back({"flow", 2, Domain::vertex, {1, 2, 3, 4, 5, 6, 7, 8}});
  const TriangleMesh back = round_trip(mesh);
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.find("uv"), nullptr);
  for (const char* name : {"u_", "v_", "x_", "red_", "a_b", "a-b", "a_b_"})
    EXPECT_EQ(back.find(name)->values, (std::vector<double>{1, 2, 3, 4})) << name;
  EXPECT_EQ(back.find("flow_2")->values, (std::vector<double>{2, 4, 6, 8}));
}

TEST(PlyWriter, SizeIsWhatTheHeaderPromises) {
  const TriangleMesh mesh = test::closed_mesh();
  const std::string bytes = encode_ply(mesh);
  const std::size_t header = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.size(), header + mesh.points.size() * (6 * 4 + 3 + 2 * 4) + mesh.triangles.size() * 13);
}

}  // namespace
}  // namespace pelage
