#include "io/glb_writer.h"

#include <cstring>

#include "io/gltf_reader.h"
#include "io/written_meshes.h"
#include "pelage/error.h"

namespace pelage {
namespace {

TriangleMesh round_trip(const TriangleMesh& mesh) { return test::raw_mesh(read_gltf(encode_glb(mesh), "a.glb")); }

/// The JSON text within a GLB file.
std::string json_of(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return bytes.substr(20, length);
}

TEST(GlbWriter, RoundTripClosed) {
  const TriangleMesh mesh = test::closed_mesh(), back = round_trip(mesh);
  EXPECT_TRUE(test::same_places(mesh, back));
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(test::corner_difference(mesh, mesh.find("color"), back, back.find("color")), 0);
}

TEST(GlbWriter, RoundTripSeams) {
  const TriangleMesh mesh = test::seamed_mesh(), back = round_trip(mesh);
  EXPECT_TRUE(test::same_places(mesh, back));
  EXPECT_LT(test::corner_difference(mesh, mesh.find("uv"), back, back.find("uv")), 1e-7);
}

TEST(GlbWriter, HeaderCountsAllBytes) {
  const std::string bytes = encode_glb(test::seamed_mesh());
  std::uint32_t words[5];
  std::memcpy(words, bytes.data(), sizeof words);
  EXPECT_EQ(words[0], 0x46546C67U);  // "glTF"
  EXPECT_EQ(words[1], 2U);
  EXPECT_EQ(words[2], bytes.size());
  EXPECT_EQ(words[4], 0x4E4F534AU);  // "JSON"
}

TEST(GlbWriter, CustomAttributesAndGenerator) {
  const std::string json = json_of(encode_glb(test::closed_mesh()));
  for (const char* part : {"\"_A\"", "\"_LEVEL_2\"", "\"COLOR_0\"", "\"NORMAL\"", "\"generator\":\"pelage\""})
    EXPECT_NE(json.find(part), std::string::npos) << part;
}

TEST(GlbWriter, OnlyOpenSurfacesAreDoubleSided) {
  const auto double_sided = [](const TriangleMesh& mesh) {
    return json_of(encode_glb(mesh)).find("\"doubleSided\":true") != std::string::npos;
  };
  EXPECT_FALSE(double_sided(test::closed_mesh()));
  EXPECT_TRUE(double_sided(test::seamed_mesh()));
  TriangleMesh open = test::closed_mesh();
  open.triangles.pop_back();
  EXPECT_TRUE(double_sided(open));
}

TEST(GlbWriter, ColoursAreClamped) {
  TriangleMesh mesh = test::tetrahedron();
  mesh.attributes.push_back({"color", 3, Domain::vertex, {-1, 0, 0.25, 2, 1, 1, 0, 0, 0, 1, 1, 1}});
  const std::vector<double> clamped = {0, 0, 0.25, 1, 1, 1, 0, 0, 0, 1, 1, 1};
  EXPECT_EQ(round_trip(mesh).find("color")->values, clamped);
}

TEST(GlbWriter, RefusesNothing) { EXPECT_THROW(encode_glb({}), Error); }

}  // namespace
}  // namespace pelage
