#include "io/vtp_reader.h"

#include <gtest/gtest.h>

#include "io/vtp_writer.h"
#include "pelage/error.h"
#include "pelage/io.h"

namespace pelage {
namespace {

/// A triangle and a square, with values of every kind.
PolygonMesh two_faces() {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.25, 2, 0}};
  mesh.corners = {0, 1, 2, 3, 3, 2, 4};
  mesh.face_ends = {4, 7};
  mesh.attributes = {{"heat", 1, Domain::vertex, {1, 2, 3, 4, 5}, NumberType::float64},
                     {"color", 3, Domain::vertex, std::vector<double>(15, 1.0), NumberType::uint8},
                     {"part", 1, Domain::face, {0, 1}, NumberType::int32}};
  return mesh;
}

TEST(VtpReader, TakesBackWhatTheWriterWrites) {
  const PolygonMesh mesh = two_faces();
  const RawShape raw = read_vtp(encode_vtp(mesh), "a.vtp");
  EXPECT_EQ(raw.mesh.points, mesh.points);
  EXPECT_EQ(raw.mesh.corners, mesh.corners);
  EXPECT_EQ(raw.mesh.face_ends, mesh.face_ends);
  ASSERT_EQ(raw.mesh.attributes.size(), 3u);
  for (const Attribute& a : mesh.attributes) {
    EXPECT_EQ(raw.mesh.find(a.name)->values, a.values) << a.name;
    EXPECT_EQ(raw.mesh.find(a.name)->domain, a.domain) << a.name;
    EXPECT_EQ(raw.mesh.find(a.name)->type, a.type) << a.name;
  }
  EXPECT_TRUE(raw.findings.empty());
}

/// VTK's programs show points that are in cells: a cloud is written with one for each.
TEST(VtpReader, ACloudComesBack) {
  PolygonMesh cloud;
  for (int i = 0; i < 40; ++i) cloud.points.push_back({i % 8 + 0.5, i / 8 + 0.25, 0.125});
  cloud.attributes = {{"heat", 1, Domain::vertex, std::vector<double>(40, 7), NumberType::float64}};
  const std::string bytes = encode_vtp(cloud);
  EXPECT_NE(bytes.find("NumberOfVerts=\"40\""), std::string::npos);
  const ShapeFile read = read_shape_bytes(bytes, "a.vtp");
  EXPECT_EQ(read.mesh.points, cloud.points);
  EXPECT_TRUE(read.mesh.triangles.empty());
  EXPECT_EQ(read.mesh.find("heat")->values, cloud.attributes[0].values);
}

std::string file(const std::string& counts, const std::string& cells, const std::string& data = "") {
  return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData><Piece "
         "NumberOfPoints=\"4\" " +
         counts +
         "><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0" +
         "</DataArray></Points>" + cells + data + "</Piece></PolyData></VTKFile>\n";
}
std::string cells(const std::string& kind, const std::string& corners, const std::string& ends) {
  return "<" + kind + "><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + corners +
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" + ends + "</DataArray></" + kind +
         ">";
}

/// Values of cells are in the order of vertices, lines, polygons and strips.
TEST(VtpReader, LeavesOutWhatIsNoPolygon) {
  const std::string text =
      file("NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfPolys=\"2\" NumberOfStrips=\"0\"",
           cells("Verts", "0", "1") + cells("Lines", "0 1", "2") + cells("Polys", "0 1 2 0 2 3", "3 6"),
           "<CellData><DataArray type=\"Float64\" Name=\"heat\" format=\"ascii\">1 2 3 4</DataArray></CellData>");
  const RawShape raw = read_vtp(text, "a.vtp");
  EXPECT_EQ(raw.mesh.corners, (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(raw.mesh.find("heat")->values, (std::vector<double>{3, 4}));
  ASSERT_EQ(raw.findings.size(), 2u);
  EXPECT_EQ(raw.findings[0].text, "1 vertex cell; left out");
}

TEST(VtpReader, RefusesWhatIsDamaged) {
  const auto refused = [](const std::string& text, const std::string& what) {
    try {
      read_vtp(text, "a.vtp");
      ADD_FAILURE() << what;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
    }
  };
  refused(file("NumberOfPolys=\"1\"", cells("Polys", "0 1 4", "3")), "polygon 0 has the point 4");
  refused(file("NumberOfPolys=\"2\"", cells("Polys", "0 1 2", "3 2")), "the offset of polygon 1");
  refused(file("NumberOfPolys=\"1\"", ""), "no array \"offsets\"");
  refused("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>", "read from PolyData");
  refused(file("NumberOfPolys=\"1\"", cells("Polys", "0 1 2", "3"),
               "<CellData><DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">32</DataArray></CellData>"),
          "hidden");
}

}  // namespace
}  // namespace pelage
