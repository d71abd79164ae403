#include "io/glb_writer.h"

#include <array>
#include <cstring>
#include <map>
#include <utility>

#include "io/gltf_image.h"
#include "io/gltf_reader.h"
#include "io/written_meshes.h"
#include "pelage/error.h"
#include "pelage/io.h"

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

TEST(GlbWriter, ATextureIsTheBaseColourInsteadOfTheVertices) {
  const TriangleMesh mesh = test::seamed_mesh();
  auto image = std::make_shared<Pixels>(Pixels{3, 2, 3, {}});
  for (int i = 0; i < 18; ++i) image->bytes.push_back(static_cast<std::uint8_t>(15 * i));
  TriangleMesh colored = mesh;
  colored.set({"color", 3, Domain::vertex, std::vector<double>(3 * mesh.points.size(), 0.5)});
  const std::string bytes = encode_glb(colored, {"mesh", UpAxis::y, {{image}}}), json = json_of(bytes);
  EXPECT_EQ(gltf_base_image(bytes, "a.glb"), png_bytes(*image));
  EXPECT_NE(json.find("\"baseColorTexture\":{\"index\":0}"), std::string::npos) << json;
  EXPECT_EQ(json.find("COLOR_0"), std::string::npos);
  const TriangleMesh back = test::raw_mesh(read_gltf(bytes, "a.glb"));
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

TEST(GlbWriter, MeshAndNodeHaveTheName) {
  const std::string json = json_of(encode_glb(test::tetrahedron(), {.name = "cow \"2\""}));
  const std::string name = R"("name":"cow \"2\"")";
  const std::size_t first = json.find(name);
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(json.find(name, first + 1), std::string::npos);
  EXPECT_NE(json_of(encode_glb(test::tetrahedron(), {.name = "k\xff\xc3\xa4"
                                                             "fer"}))
                .find("k\xef\xbf\xbd\xc3\xa4"
                      "fer"),
            std::string::npos);
}

/// Terrain in metres of a map: half a kilometre of it, 5400 km from the equator.
TriangleMesh far_away(double distance) {
  TriangleMesh mesh = test::closed_mesh();
  for (Point& p : mesh.points) p = {250 * p[0] + 0.07 * distance, 250 * p[1] + distance, 250 * p[2]};
  return mesh;
}

TEST(GlbWriter, FarFromTheOriginNothingIsLost) {
  for (const double distance : {5.4e6, -3e9, 4e12}) {
    const TriangleMesh mesh = far_away(distance), back = round_trip(mesh);
    const double own_rounding = std::abs(distance) * 3e-16;  // of the doubles that are given
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back.points[v][k], mesh.points[v][k], 1e-6 * 500 + own_rounding);
  }
  EXPECT_EQ(json_of(encode_glb(far_away(0))).find("translation"), std::string::npos);
  EXPECT_NE(json_of(encode_glb(far_away(5.4e6))).find("translation"), std::string::npos);
}

TEST(GlbWriter, TurnedUpright) {
  TriangleMesh mesh = test::tetrahedron();
  const std::size_t n = mesh.points.size();
  mesh.points[0] = {1, 2, 3};
  for (const char* name : {"normal", "Direction", "velocity"}) {
    Attribute a{name, 3, Domain::vertex, {}};
    for (std::size_t v = 0; v < n; ++v) a.values.insert(a.values.end(), {0, 0, 1});
    mesh.attributes.push_back(a);
  }
  for (const auto& [name, value] : {std::pair{"direction_x", 1}, {"direction_y", 2}, {"direction_z", 3}})
    mesh.attributes.push_back({name, 1, Domain::vertex, std::vector<double>(n, value)});
  const std::string bytes = encode_glb(mesh, {.up = UpAxis::z});
  const TriangleMesh back = test::raw_mesh(read_gltf(bytes, "a.glb"));
  EXPECT_EQ(back.points[0], (Point{1, 3, -2}));
  EXPECT_EQ(back.triangles, mesh.triangles);
  const auto first = [&](const char* name) {
    const std::vector<double>& v = back.find(name)->values;
    return std::vector<double>(v.begin(), v.begin() + 3);
  };
  EXPECT_EQ(first("DIRECTION"), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(first("DIRECTION_X")[0], 1);
  EXPECT_EQ(first("DIRECTION_Y")[0], 3);
  EXPECT_EQ(first("DIRECTION_Z")[0], -2);
  EXPECT_EQ(first("VELOCITY"), (std::vector<double>{0, 0, 1}));  // of axes that we do not know
  EXPECT_EQ(test::raw_mesh(read_gltf(encode_glb(mesh), "a.glb")).points[0], (Point{1, 2, 3}));
}

TEST(GlbWriter, ObjectsAreNodesAndMaterialsAreParts) {
  TriangleMesh mesh = test::seamed_mesh();
  Attribute object{"object", 1, Domain::face, {}, NumberType::int32, {"left", "right"}};
  Attribute material{"material", 1, Domain::face, {}, NumberType::int32, {"Fur", "Glass"}};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {  // sorted as the file will be
    object.values.push_back(2 * f < mesh.triangles.size() ? 0 : 1);
    material.values.push_back(4 * f < 3 * mesh.triangles.size() && 4 * f >= mesh.triangles.size() ? 1 : 0);
  }
  mesh.attributes.insert(mesh.attributes.end(), {object, material});
  const std::string bytes = encode_glb(mesh, {.name = "both"});
  const std::string json = json_of(bytes);
  for (const char* part : {R"("name":"left")", R"("name":"right")", R"("name":"Fur")", R"("name":"Glass")"})
    EXPECT_NE(json.find(part), std::string::npos) << part;
  const TriangleMesh back = test::raw_mesh(read_gltf(bytes, "a.glb"));
  ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(back.find("object")->labels, object.labels);
  // The right half comes back with its furry faces first.
  std::map<std::array<Point, 3>, std::pair<std::string, std::string>> expected, found;
  const auto collect = [](const TriangleMesh& m, auto& into) {
    const Attribute &o = *m.find("object"), &p = *m.find("material");
    for (std::size_t f = 0; f < m.triangles.size(); ++f) {
      const Triangle& t = m.triangles[f];
      into[{m.points[t[0]], m.points[t[1]], m.points[t[2]]}] = {o.labels[static_cast<std::size_t>(o.values[f])],
                                                                p.labels[static_cast<std::size_t>(p.values[f])]};
    }
  };
  collect(mesh, expected);
  collect(back, found);
  EXPECT_EQ(found, expected);
}

TEST(GlbWriter, FurtherUvAndColours) {
  TriangleMesh mesh = test::tetrahedron();
  const std::size_t n = mesh.points.size();
  for (const char* name : {"uv", "uv1", "uv3"})
    mesh.attributes.push_back({name, 2, Domain::vertex, std::vector<double>(2 * n, 0.25)});
  for (const char* name : {"color", "color1"})
    mesh.attributes.push_back({name, 4, Domain::vertex, std::vector<double>(4 * n, 0.5)});
  const std::string json = json_of(encode_glb(mesh));
  for (const char* part : {"\"TEXCOORD_0\"", "\"TEXCOORD_1\"", "\"_UV3\"", "\"COLOR_0\"", "\"COLOR_1\""})
    EXPECT_NE(json.find(part), std::string::npos) << part;
  const TriangleMesh back = round_trip(mesh);
  EXPECT_EQ(back.find("uv1")->values, mesh.find("uv1")->values);
  EXPECT_EQ(back.find("color1")->values, mesh.find("color1")->values);
}

TEST(GlbWriter, RefusesNothing) { EXPECT_THROW(encode_glb({}), Error); }

}  // namespace
}  // namespace pelage
