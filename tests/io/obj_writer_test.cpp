#include "io/obj_writer.h"

#include "base/srgb.h"
#include "io/obj_reader.h"
#include "io/written_meshes.h"

namespace pelage {
namespace {

TriangleMesh round_trip(const TriangleMesh& mesh) {
  return test::raw_mesh(read_obj(encode_obj(polygons_of(mesh)), "a.obj"));
}

TEST(ObjWriter, VerticesAreNeitherSplitNorRounded) {
  TriangleMesh mesh = test::seamed_mesh();
  for (Point& p : mesh.points)
    for (double& x : p) x = x / 3 + 1e-9;
  const TriangleMesh back = round_trip(mesh);
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(test::corner_difference(mesh, mesh.find("uv"), back, back.find("uv")), 0);
  EXPECT_LT(test::corner_difference(mesh, mesh.find("color"), back, back.find("color")), 2.3e-4 / 2);
}

TEST(ObjWriter, FacesNameOnlyWhatIsThere) {
  TriangleMesh mesh = test::tetrahedron();
  EXPECT_NE(encode_obj(polygons_of(mesh)).find("\nf 1 2 3\n"), std::string::npos);
  mesh.attributes.push_back({"normal", 3, Domain::vertex, {1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0}});
  EXPECT_NE(encode_obj(polygons_of(mesh)).find("\nf 1//1 2//2 3//3\n"), std::string::npos);
  mesh.attributes.push_back({"uv", 2, Domain::vertex, {0, 0, 1, 0, 0, 1, 1, 1}});
  EXPECT_NE(encode_obj(polygons_of(mesh)).find("\nf 1/1/1 2/2/2 3/3/3\n"), std::string::npos);
  mesh.attributes.erase(mesh.attributes.begin());
  EXPECT_NE(encode_obj(polygons_of(mesh)).find("\nf 1/1 2/2 3/3\n"), std::string::npos);
}

}  // namespace
}  // namespace pelage
