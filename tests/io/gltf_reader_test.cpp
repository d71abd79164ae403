#include "io/gltf_reader.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/glb_builder.h"
#include "io/glb_writer.h"
#include "io/read_text.h"
#include "pelage/io.h"
#include "shape/describe.h"
#include "shape/repair.h"
#include "shape/sample_meshes.h"

namespace pelage {
namespace {

using test::bytes_of;
using test::glb;

/// Four corners of a square, then 6 bytes of indices (used by some), as buffer views 0 and 1.
const std::string square =
    bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + bytes_of<std::uint8_t>({0, 1, 2, 2, 1, 3});

std::string document(const std::string& primitive, const std::string& nodes = R"([{"mesh":0}])",
                     const std::string& accessors = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[)" + primitive + R"(]}],"buffers":[{"byteLength":)" +
         std::to_string(square.size()) + R"(}],"bufferViews":[{"buffer":0,"byteLength":48},
{"buffer":0,"byteOffset":48,"byteLength":6}],"accessors":[
{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})" +
         accessors + "]}";
}

RawShape read(const std::string& bytes) { return read_gltf(bytes, "a.glb"); }
RawShape read_square(const std::string& primitive, const std::string& nodes = R"([{"mesh":0}])") {
  return read(glb(document(primitive, nodes), square));
}

TEST(GltfReader, IndexedStripFanAndUnindexed) {
  const std::vector<std::int32_t> pair = {0, 1, 2, 2, 1, 3};
  EXPECT_EQ(read_square(R"({"attributes":{"POSITION":0},"indices":1})").mesh.corners, pair);
  EXPECT_EQ(read_square(R"({"attributes":{"POSITION":0},"indices":1,"mode":4})").mesh.corners, pair);
  EXPECT_EQ(read_square(R"({"attributes":{"POSITION":0},"mode":5})").mesh.corners,
            (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(read_square(R"({"attributes":{"POSITION":0},"mode":6})").mesh.corners,
            (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(read_square(R"({"attributes":{"POSITION":0}})").mesh.corners, (std::vector<std::int32_t>{0, 1, 2}));
  const RawShape points =
      read_square(R"({"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0},"indices":1})");
  EXPECT_EQ(points.mesh.corners, pair);
  EXPECT_EQ(points.findings.at(0).kind, "points-and-lines");
}

TEST(GltfReader, NodesMoveTurnScaleAndMirror) {
  const std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  const RawShape moved = read_square(primitive, R"([{"children":[1],"translation":[10,0,0]},
      {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,3,1]}])");
  const Point expected[] = {{10, 0, 0}, {10, 2, 0}, {7, 0, 0}, {7, 2, 0}};
  for (int v = 0; v < 4; ++v)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(moved.mesh.points[v][k], expected[v][k], 1e-14);
  const RawShape mirrored = read_square(primitive, R"([{"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]}])");
  EXPECT_EQ(mirrored.mesh.points[1], (Point{4, 0, 0}));
  EXPECT_EQ(mirrored.mesh.corners, (std::vector<std::int32_t>{0, 2, 1, 2, 3, 1}));
}

TEST(GltfReader, AttributesOfSeveralParts) {
  const RawShape shape = read(glb(document(R"({"attributes":{"POSITION":0},"indices":1},
      {"attributes":{"POSITION":0,"COLOR_0":2,"TEXCOORD_0":3,"_HEAT":4,"NORMAL":0},"indices":1})",
                                           R"([{"mesh":0}])", R"(,
      {"bufferView":0,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"},
      {"bufferView":0,"byteOffset":16,"componentType":5126,"count":4,"type":"VEC2"},
      {"bufferView":0,"componentType":5126,"count":4,"type":"SCALAR"})"),
                                  square));
  ASSERT_EQ(shape.mesh.attributes.size(), 3u);
  for (const Attribute& a : shape.mesh.attributes) ASSERT_EQ(a.values.size(), 8u * a.components);
  const Attribute &color = shape.mesh.attributes[0], &uv = shape.mesh.attributes[1], &heat = shape.mesh.attributes[2];
  EXPECT_EQ(color.name, "color");
  EXPECT_EQ(color.values[0], 1);                             // absent in the first part
  EXPECT_NEAR(color.values[4 * 4 + 14], 128 / 255., 1e-15);  // the float 1 is the bytes 0 0 128 63
  EXPECT_EQ(uv.name, "uv");
  EXPECT_EQ(uv.values[2 * 4 + 1], 1 - 0.0);
  EXPECT_EQ(uv.values[2 * 6 + 1], 1 - 1.0);
  EXPECT_EQ(heat.name, "HEAT");
  EXPECT_EQ(heat.values, (std::vector<double>{0, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(GltfReader, VerticesSplitAlongSeamsAreMergedAgain) {
  TriangleMesh mesh = test::torus();
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const std::int32_t v = mesh.triangles[c / 3][c % 3];
    const bool last = c / 6 % 12 == 11;  // the last quad of every ring: v runs up to 1 there, not back to 0
    uv.values.push_back(0.25 * (v / 12));
    uv.values.push_back(last && v % 12 == 0 ? 1.0 : v % 12 / 16.0);
  }
  mesh.attributes = {uv};
  std::vector<Finding> findings;
  Triangulation cut = triangulate(read(encode_glb(mesh)).mesh, findings);
  EXPECT_GT(cut.mesh.points.size(), mesh.points.size());
  const TriangleMesh result = repair(cut.mesh, findings);
  EXPECT_EQ(result.points.size(), mesh.points.size());
  EXPECT_EQ(describe(result, {}).genus, 1);
  ASSERT_TRUE(result.find("uv"));
  EXPECT_EQ(result.find("uv")->domain, Domain::corner);
  EXPECT_EQ(result.find("uv")->values, uv.values);
}

TEST(GltfReader, TextFormWithABufferBeside) {
  const std::string folder = testing::TempDir() + "pelage_gltf";
  std::filesystem::create_directories(folder);
  std::string json = document(R"({"attributes":{"POSITION":0},"indices":1})");
  json.replace(json.find("\"byteLength\""), 0, R"("uri":"square.bin",)");
  std::ofstream(folder + "/a.gltf") << json;
  std::filesystem::remove(folder + "/square.bin");
  test::expect_input_error([&] { read_shape(folder + "/a.gltf"); }, "square.bin");
  std::ofstream(folder + "/square.bin", std::ios::binary) << square;
  EXPECT_EQ(read_shape(folder + "/a.gltf").mesh.triangles.size(), 2u);
  std::filesystem::remove_all(folder);
}

TEST(GltfReader, SaysWhatIsWrong) {
  auto error = [](const std::string& bytes, const char* part) { test::expect_input_error([&] { read(bytes); }, part); };
  const std::string good = R"({"attributes":{"POSITION":0},"indices":1})";
  error(R"({"asset":{"version":"1.0"}})", "is glTF 1.0; only glTF 2.0");
  error(R"({"asset":{"version":"2.0"},"scene":1)" + std::string(400, '0') + "}", "a number that is too large");
  error("{\n \"asset\" 3}", "its JSON is damaged at line 2, column 10");
  error("glTF", "a.glb: is no valid glTF file");
  error("{", "a.glb: is no valid glTF file");
  error("[]", "a.glb: is no valid glTF file");
  error("nothing of the kind", "a.glb: is no valid glTF file");
  error(glb("{}", "1234"), "a.glb: is no valid glTF file");
  const std::string whole = glb(document(good), square);
  for (std::size_t length = 0; length < whole.size(); length += 7) error(whole.substr(0, length), "a.glb: ");
  auto broken = [&](const char* from, const char* to) {
    std::string json = document(good);
    json.replace(json.find(from), std::strlen(from), to);
    return glb(json, square);
  };
  error(broken("\"count\":4", "\"count\":4000000000"), "accessor 0 promises more");
  error(broken("\"count\":4", "\"count\":5"), "accessor 0 promises more");
  error(broken("\"byteLength\":48", "\"byteLength\":4000"), "lies beyond");
  for (const std::string offset : {"48", "49", "50"})  // at its end, and beyond
    error(broken("\"count\":4", ("\"byteOffset\":" + offset + ",\"count\":4").c_str()),
          offset == "48" ? "accessor 0 promises more" : "accessor 0 lies beyond its buffer view");
  error(broken("\"count\":4", "\"count\":3"), "mesh 0 has index 3");
  error(broken("\"POSITION\":0", "\"POSITION\":9"), "accessor 9 does not exist");
  error(broken("\"POSITION\":0", "\"NORMAL\":0"), "no POSITION");
  error(broken("\"nodes\":[0]", "\"nodes\":[3]"), "node 3 does not exist");
  error(broken("\"mesh\":0", "\"mesh\":0,\"children\":[0]"), "must form a tree");
  error(broken("\"mesh\":0", "\"mesh\":0},{\"children\":[0,0]"), "two parents");
  error(broken("\"mesh\":0", "\"mesh\":5"), "mesh 5 does not exist");
}

}  // namespace
}  // namespace pelage
