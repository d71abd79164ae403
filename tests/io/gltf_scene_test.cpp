// glTF as other programs write it: skins, morph targets, instances, scenes, sparse and quantised arrays. Every expected
// figure is worked out by hand.

#include <cmath>

#include "io/glb_builder.h"
#include "io/gltf_reader.h"
#include "io/read_text.h"
#include "pelage/io.h"
#include "shape/describe.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using test::GlbBuilder;

const std::vector<float> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

RawShape read(const std::string& bytes) { return read_gltf(bytes, "a.glb"); }

void expect_points(const RawShape& shape, const std::vector<Point>& expected, double tolerance = 1e-12) {
  ASSERT_EQ(shape.mesh.points.size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(shape.mesh.points[v][k], expected[v][k], tolerance) << v << " " << k;
}

const Finding* find(const RawShape& shape, const std::string& kind) {
  for (const Finding& f : shape.findings)
    if (f.kind == kind) return &f;
  return nullptr;
}

void expect_finding(const RawShape& shape, const std::string& kind, const std::string& part) {
  const Finding* f = find(shape, kind);
  ASSERT_TRUE(f) << kind;
  EXPECT_NE(f->text.find(part), std::string::npos) << f->text;
  EXPECT_EQ(f->text.find('\n'), std::string::npos);
}

const Attribute& attribute(const RawShape& shape, const std::string& name) {
  for (const Attribute& a : shape.mesh.attributes)
    if (a.name == name) return a;
  static const Attribute none;
  ADD_FAILURE() << "no attribute " << name;
  return none;
}

std::string sparse(int count, int indices, int values) {
  return R"(,"sparse":{"count":)" + std::to_string(count) + R"(,"indices":{"bufferView":)" + std::to_string(indices) +
         R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}";
}

// --- sparse arrays ----------------------------------------------------------------------------------------

TEST(GltfSparse, ReplacesSomeValues) {
  GlbBuilder file;
  const int base = file.view(test::bytes_of(triangle));
  const int indices = file.view(test::bytes_of<std::uint8_t>({1})),
            values = file.view(test::bytes_of<float>({5, 6, 7}));
  file.accessor("VEC3", 5126, 3, ",\"bufferView\":" + std::to_string(base) + sparse(1, indices, values));
  expect_points(read(file.file_of(R"("attributes":{"POSITION":0})")), {{0, 0, 0}, {5, 6, 7}, {0, 1, 0}});
}

TEST(GltfSparse, OverZeros) {
  GlbBuilder file;
  const int indices = file.view(test::bytes_of<std::uint8_t>({0, 2}));
  const int values = file.view(test::bytes_of<float>({1, 0, 0, 0, 1, 0}));
  file.accessor("VEC3", 5126, 3, sparse(2, indices, values));
  expect_points(read(file.file_of(R"("attributes":{"POSITION":0})")), {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}});
}

TEST(GltfSparse, IndicesOfFaces) {
  GlbBuilder file;
  file.array("VEC3", std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const int base = file.view(test::bytes_of<std::uint16_t>({0, 1, 2}));
  const int places = file.view(test::bytes_of<std::uint8_t>({0, 1})),
            values = file.view(test::bytes_of<std::uint16_t>({3, 2}));
  file.accessor("SCALAR", 5123, 3, ",\"bufferView\":" + std::to_string(base) + sparse(2, places, values));
  EXPECT_EQ(read(file.file_of(R"("attributes":{"POSITION":0},"indices":1)")).mesh.corners,
            (std::vector<std::int32_t>{3, 2, 2}));
}

TEST(GltfSparse, WrongOnesAreRefused) {
  const auto refused = [](const std::vector<std::uint8_t>& indices, int count, const std::string& text) {
    GlbBuilder file;
    const int places = file.view(test::bytes_of(indices)),
              values = file.view(test::bytes_of<float>({1, 0, 0, 0, 1, 0}));
    file.accessor("VEC3", 5126, 3, sparse(count, places, values));
    test::expect_input_error([&] { read(file.file_of(R"("attributes":{"POSITION":0})")); }, text);
  };
  refused({0, 3}, 2, "accessor 0 has sparse indices that do not rise or are too large");
  refused({1, 1}, 2, "accessor 0 has sparse indices that do not rise or are too large");
  refused({0, 1, 2}, 3, "accessor 0 promises more sparse values");
  GlbBuilder zeros;
  const int places = zeros.view(test::bytes_of<std::uint8_t>({0})),
            values = zeros.view(test::bytes_of<float>({1, 0, 0}));
  zeros.accessor("VEC3", 5126, 4000000000, sparse(1, places, values));
  test::expect_input_error([&] { read(zeros.file_of(R"("attributes":{"POSITION":0})")); }, "values without data");
  GlbBuilder nothing;
  nothing.accessor("VEC3", 5126, 3, "");
  test::expect_input_error([&] { read(nothing.file_of(R"("attributes":{"POSITION":0})")); }, "accessor 0 has no data");
}

// --- quantised arrays -------------------------------------------------------------------------------------

TEST(GltfQuantization, PositionsOfAllTypes) {
  const auto points = [](auto one, bool normalized) {
    using T = decltype(one);
    GlbBuilder file;
    file.array("VEC3", std::vector<T>{0, 0, 0, one, 0, 0, 0, one, 0}, normalized ? ",\"normalized\":true" : "");
    return read(file.file_of(R"("attributes":{"POSITION":0})",
                             R"(,"extensionsUsed":["KHR_mesh_quantization"],
                             "extensionsRequired":["KHR_mesh_quantization"])"));
  };
  const std::vector<Point> unit = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expect_points(points(std::int8_t{127}, true), unit);
  expect_points(points(std::uint8_t{255}, true), unit);
  expect_points(points(std::int16_t{32767}, true), unit);
  expect_points(points(std::uint16_t{65535}, true), unit);
  expect_points(points(std::int16_t{-300}, false), {{0, 0, 0}, {-300, 0, 0}, {0, -300, 0}});
  expect_points(points(std::int8_t{-128}, true), {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}});
}

TEST(GltfQuantization, InterleavedPositionsScaledByTheNode) {
  GlbBuilder file;
  const int view =
      file.view(test::bytes_of<std::uint16_t>({0, 0, 0, 9, 100, 0, 0, 9, 0, 200, 0, 9}), ",\"byteStride\":8");
  file.accessor("VEC3", 5123, 3, ",\"bufferView\":" + std::to_string(view));
  expect_points(read(file.file(R"("nodes":[{"mesh":0,"scale":[0.01,0.01,0.01],"translation":[1,2,3]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])")),
                {{1, 2, 3}, {2, 2, 3}, {1, 4, 3}});
}

// --- morph targets ----------------------------------------------------------------------------------------

/// Two targets, the second sparse; `mesh` and `node` may hold weights.
std::string morphs(const std::string& mesh, const std::string& node) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC3", std::vector<float>{0, 0, 10, 0, 0, 20, 0, 0, 30});
  const int indices = file.view(test::bytes_of<std::uint8_t>({2})),
            values = file.view(test::bytes_of<float>({100, 0, 0}));
  file.accessor("VEC3", 5126, 3, sparse(1, indices, values));
  return file.file(R"("nodes":[{"mesh":0)" + node + R"(}],"meshes":[{"extras":{"targetNames":["smile","blink"]})" +
                   mesh +
                   R"(,"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":2}]}]}])");
}

TEST(GltfMorph, AtTheWeightsOfTheMesh) {
  const RawShape shape = read(morphs(R"(,"weights":[0.5,0.25])", ""));
  expect_points(shape, {{0, 0, 5}, {1, 0, 10}, {25, 1, 15}});
  expect_finding(shape, "morph-targets", "2 morph targets, taken at the weights smile 0.5, blink 0.25");
}

TEST(GltfMorph, TheNodeOverridesTheMesh) {
  expect_points(read(morphs(R"(,"weights":[0.5,0.25])", R"(,"weights":[0,-1])")), {{0, 0, 0}, {1, 0, 0}, {-100, 1, 0}});
}

TEST(GltfMorph, WithoutWeightsNothingMoves) {
  const RawShape shape = read(morphs("", ""));
  expect_points(shape, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  expect_finding(shape, "morph-targets", "smile 0, blink 0");
}

TEST(GltfMorph, QuantisedTargetsAndOtherAttributes) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC3", std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 0, 0, 0}, ",\"normalized\":true");
  file.array("VEC2", std::vector<float>{0, 0, 1, 0, 0, 1});
  file.array("VEC2", std::vector<float>{0.5, 0, 0, 0, 0, 0});
  const RawShape shape = read(file.file(R"("nodes":[{"mesh":0}],"meshes":[{"weights":[0.5],"primitives":[{
      "attributes":{"POSITION":0,"TEXCOORD_0":2},"targets":[{"POSITION":1,"TEXCOORD_0":3}]}]}])"));
  expect_points(shape, {{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(attribute(shape, "uv").values, (std::vector<double>{0.25, 1, 1, 1, 0, 0}));
}

TEST(GltfMorph, TargetsOfTheWrongSizeAreRefused) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC3", std::vector<float>{0, 0, 1});
  test::expect_input_error([&] { read(file.file_of(R"("attributes":{"POSITION":0},"targets":[{"POSITION":1}])")); },
                           "mesh 0 has a morph target of 1 values for 3 vertices");
}

// --- skins ------------------------------------------------------------------------------------------------

/// A triangle between two joints: the root at x = 10, its child turned by a quarter around z, one unit further up.
std::string skinned(const std::string& joints, const std::string& weights, const std::string& skin) {
  GlbBuilder file;
  file.array("VEC3", triangle);                                                        // 0
  file.array("VEC4", std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});   // 1
  file.array("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0});      // 2
  file.array("VEC4", std::vector<std::uint16_t>{0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});  // 3
  file.array("VEC4", std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 128, 128, 0, 0},
             ",\"normalized\":true");                                                     // 4
  file.array("MAT4", std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  // 5
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  return file.file(R"("nodes":[{"mesh":0,"skin":0,"translation":[1000,0,0],"scale":[7,7,7]},
      {"translation":[10,0,0],"children":[2]},
      {"translation":[0,1,0],"rotation":[0,0,0.7071067811865476,0.7071067811865476]}],
      "skins":[{"joints":[1,2])" +
                   skin + R"(}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":)" +
                   joints + R"(,"WEIGHTS_0":)" + weights + "}}]}]");
}

// Joint 0 moves by (10,0,0). Joint 1 turns (x,y) to (-y,x), then moves by (10,1,0).
const std::vector<Point> bound = {{10, 0, 0}, {10, 2, 0}, {9.5, 1, 0}};

TEST(GltfSkin, WithoutInverseBindMatrices) { expect_points(read(skinned("1", "2", "")), bound); }
TEST(GltfSkin, ShortJointsAndByteWeights) { expect_points(read(skinned("3", "4", "")), bound, 1e-12); }

// Joint 1 first moves by (0,-1,0): (1,0) -> (1,-1) -> (1,1) -> (11,2); (0,1) -> (0,0) -> (10,1), in the middle of it
// and (10,1) of joint 0.
TEST(GltfSkin, WithInverseBindMatrices) {
  expect_points(read(skinned("1", "2", R"(,"inverseBindMatrices":5)")), {{10, 0, 0}, {11, 2, 0}, {10, 1, 0}});
}

TEST(GltfSkin, FaultsAreNamed) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC4", std::vector<std::uint8_t>{0, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0});
  file.array("VEC4", std::vector<float>{0.5, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
  file.array("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  file.array("MAT4", std::vector<float>(16));
  const auto bytes = [&](int weights, const std::string& skin) {
    return file.file(R"("nodes":[{"mesh":0,"skin":0},{"translation":[1,0,0]}],"skins":[{)" + skin + R"(}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":)" +
                     std::to_string(weights) + "}}]}]");
  };
  const RawShape odd = read(bytes(2, R"("joints":[1,1,1,1,1,1])"));
  expect_points(odd, {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}});
  expect_finding(odd, "skin-weights", "2 vertices whose skin weights do not sum to 1");
  test::expect_input_error([&] { read(bytes(3, R"("joints":[1])")); }, "mesh 0 refers to joint 5, but its skin has 1");
  test::expect_input_error([&] { read(bytes(3, R"("joints":[])")); }, "skin 0 has no joints");
  test::expect_input_error([&] { read(bytes(3, R"("joints":[7])")); }, "node 7 does not exist");
  test::expect_input_error([&] { read(bytes(3, R"("joints":[1,1],"inverseBindMatrices":4)")); },
                           "skin 0 has fewer inverse bind matrices than joints");
}

TEST(GltfSkin, WithoutWeightsTheNodeCounts) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  const RawShape shape = read(file.file(R"("nodes":[{"mesh":0,"skin":0,"translation":[5,0,0]},{"translation":[1,0,0]}],
      "skins":[{"joints":[1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
  expect_points(shape, {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  expect_finding(shape, "unskinned-parts", "1 part");
}

// --- instances --------------------------------------------------------------------------------------------

TEST(GltfInstancing, MovesTurnsAndScales) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC3", std::vector<float>{0, 0, 0, 0, 0, 5});
  file.array("VEC4", std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0}, ",\"normalized\":true");
  file.array("VEC3", std::vector<float>{1, 1, 1, 2, -2, 2});
  file.array("SCALAR", std::vector<float>{3, 4});
  const RawShape shape = read(file.file(R"("nodes":[{"mesh":0,"translation":[100,0,0],"extensions":{
      "EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"ROTATION":2,"SCALE":3,"_ID":4}}}}],
      "extensionsRequired":["EXT_mesh_gpu_instancing"],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
  // The second: scaled to (2x, -2y), turned by a half around z to (-2x, 2y).
  expect_points(shape, {{100, 0, 0}, {101, 0, 0}, {100, 1, 0}, {100, 0, 5}, {98, 0, 5}, {100, 2, 5}});
  EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2, 3, 5, 4}));  // mirrored
  expect_finding(shape, "left-out-attributes", "_ID of instances");
}

TEST(GltfInstancing, ArraysOfDifferentLengthsAreRefused) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC3", std::vector<float>{0, 0, 0});
  test::expect_input_error(
      [&] {
        read(file.file(R"("nodes":[{"name":"tree","mesh":0,"extensions":{
            "EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,"SCALE":1}}}}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
      },
      "node \"tree\" has instances whose SCALE does not fit");
}

// --- scenes -----------------------------------------------------------------------------------------------

std::string scenes(const std::string& members) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  const std::string primitive = R"({"primitives":[{"attributes":{"POSITION":0}}])";
  return file.file(R"("nodes":[{"mesh":0},{"mesh":1,"translation":[0,0,9],"name":"far"}],"meshes":[)" + primitive +
                   "}," + primitive + R"(,"name":"second"}],)" + members);
}

TEST(GltfScene, TheDefaultOneIsTakenAndTheOthersAreNamed) {
  const RawShape shape = read(scenes(R"("scene":1,"scenes":[{"nodes":[0],"name":"near"},{"nodes":[1],"name":"sky"}])"));
  expect_points(shape, {{0, 0, 9}, {1, 0, 9}, {0, 1, 9}});
  expect_finding(shape, "other-scenes", "scene \"sky\", the default one, is taken; left out: scene \"near\"");
  expect_finding(shape, "unused-meshes", "mesh 0: not in the scene, left out");
}

TEST(GltfScene, WithoutADefaultTheFirst) {
  const RawShape shape = read(scenes(R"("scenes":[{"nodes":[0]},{"nodes":[1]}])"));
  expect_points(shape, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  expect_finding(shape, "other-scenes", "scene 0, the first one, is taken; left out: scene 1");
  expect_finding(shape, "unused-meshes", "mesh \"second\"");
}

TEST(GltfScene, WithoutScenesAllNodes) {
  const RawShape shape = read(scenes(R"("animations":[{}],"cameras":[{},{}])"));
  EXPECT_EQ(shape.mesh.points.size(), 6u);
  ASSERT_EQ(shape.findings.size(), 1u);
  expect_finding(shape, "not-surface", "1 animation, 2 cameras");
  test::expect_input_error([] { read(scenes(R"("scene":2,"scenes":[{"nodes":[0]}])")); },
                           "default scene 2 does not exist");
}

TEST(GltfScene, HiddenNodesAreLeftOut) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  const RawShape shape = read(file.file(R"("nodes":[{"mesh":0},{"name":"attic","children":[2],
      "extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
  EXPECT_EQ(shape.mesh.points.size(), 3u);
  expect_finding(shape, "hidden-nodes", "node \"attic\"");
}

// --- extensions -------------------------------------------------------------------------------------------

TEST(GltfExtensions, UnknownRequiredOnesAreRefusedByName) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  const auto bytes = [&](const std::string& extensions) {
    return file.file_of(R"("attributes":{"POSITION":0})", "," + extensions);
  };
  test::expect_input_error([&] { read(bytes(R"("extensionsRequired":["KHR_materials_unlit","EXT_blobs","X_y"])")); },
                           "requires EXT_blobs, X_y, which are not extensions of glTF that can be read");
  const RawShape used = read(bytes(R"("extensionsUsed":["KHR_materials_unlit","KHR_texture_basisu","EXT_blobs"],
      "extensionsRequired":["KHR_materials_unlit","KHR_texture_basisu"])"));
  ASSERT_EQ(used.findings.size(), 1u);
  expect_finding(used, "unknown-extensions", "1 unknown extension (EXT_blobs)");
}

// --- materials and attributes -----------------------------------------------------------------------------

std::string textured(const std::string& info) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC2", std::vector<float>{0, 0, 1, 0, 0, 1});
  file.array("VEC2", std::vector<std::uint16_t>{0, 0, 32768, 0, 0, 16384}, ",\"normalized\":true");
  return file.file_of(R"("material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2})",
                      R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" + info + R"(}}}],
                      "textures":[{"source":0}],"images":[{"uri":"fur%20coat.png"}])");
}

void expect_uv(const RawShape& shape, const std::string& name, const std::vector<double>& expected) {
  const Attribute& uv = attribute(shape, name);
  ASSERT_EQ(uv.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(uv.values[i], expected[i], 1e-12) << i;
}

TEST(GltfMaterial, UvIsThatOfTheTexture) {
  const RawShape plain = read(textured(""));
  expect_uv(plain, "uv", {0, 1, 1, 1, 0, 0});
  expect_uv(plain, "uv1", {0, 1, 32768 / 65535., 1, 0, 1 - 16384 / 65535.});
  expect_finding(plain, "textures", "1 base colour texture (fur coat.png) left out");
  const RawShape second = read(textured(R"(,"texCoord":1)"));
  expect_uv(second, "uv0", {0, 1, 1, 1, 0, 0});
  expect_uv(second, "uv", {0, 1, 32768 / 65535., 1, 0, 1 - 16384 / 65535.});
}

TEST(GltfMaterial, TextureTransform) {
  const auto transform = [](const std::string& members) {
    return read(textured(R"(,"texCoord":1,"extensions":{"KHR_texture_transform":{"texCoord":0,)" + members + "}}"));
  };
  // With v downwards (0,0), (1,0), (0,1) become ...; then v is turned upwards.
  expect_uv(transform(R"("offset":[0.25,0.5])"), "uv", {0.25, 0.5, 1.25, 0.5, 0.25, -0.5});
  expect_uv(transform(R"("scale":[2,3])"), "uv", {0, 1, 2, 1, 0, -2});
  // A quarter counter-clockwise as one sees it: (1,0) goes up to (0,-1), (0,1) to the right to (1,0).
  expect_uv(transform(R"("rotation":1.5707963267948966)"), "uv", {0, 1, 0, 2, 1, 1});
  // First scaled: (2,0), (0,3); then turned: (0,-2), (3,0); then moved: (0.5,0), (0.5,-2), (3.5,0).
  expect_uv(transform(R"("offset":[0.5,0],"rotation":1.5707963267948966,"scale":[2,3])"), "uv",
            {0.5, 1, 0.5, 3, 3.5, 1});
}

TEST(GltfMaterial, TexturesThatDisagreeAreReported) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC2", std::vector<float>{0, 0, 1, 0, 0, 1});
  const RawShape shape = read(file.file_of(R"("material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1})",
                                           R"(,"materials":[{"normalTexture":{"index":0},
      "emissiveTexture":{"index":0,"texCoord":1}}])"));
  expect_finding(shape, "several-uv", "different uv");
}

TEST(GltfMaterial, BaseColoursWhereThereAreNoVertexColours) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC4", std::vector<std::uint8_t>{255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 0}, ",\"normalized\":true");
  const std::string materials = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,0.5,1,1]}},{}])",
                    plain = R"("POSITION":0)";
  const auto shape = [&](const std::string& first, const std::string& second) {
    return read(file.file(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"material":0,"attributes":{)" + first +
                          R"(}},{"material":1,"attributes":{)" + second + "}}]}]" + materials));
  };
  const RawShape without = shape(plain, plain);
  EXPECT_EQ(attribute(without, "color").values,
            (std::vector<double>{0, 0.5, 1, 0, 0.5, 1, 0, 0.5, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  expect_finding(without, "base-colors", "2 parts without vertex colours");
  const RawShape both = shape(plain, R"("POSITION":0,"COLOR_0":1)");
  EXPECT_EQ(attribute(both, "color").values, (std::vector<double>{0, 0.5, 1, 1, 0, 0.5, 1, 1, 0, 0.5, 1, 1,  //
                                                                  1, 0,   0, 1, 1, 0,   0, 1, 1, 0,   0, 0}));
  const RawShape tinted = shape(R"("POSITION":0,"COLOR_0":1)", R"("POSITION":0,"COLOR_0":1)");
  EXPECT_EQ(attribute(tinted, "color").values[0], 1);
  expect_finding(tinted, "tinted-colors", "1 part");
}

TEST(GltfAttributes, KeepTheirNamesAndTypes) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("SCALAR", std::vector<std::uint32_t>{16777217, 4294967295, 0});
  file.array("VEC3", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  const RawShape shape =
      read(file.file_of(R"("attributes":{"POSITION":0,"_ID":1,"_DIRECTION":2,"NORMAL":2,"TANGENT":2})"));
  EXPECT_EQ(attribute(shape, "ID").values, (std::vector<double>{16777217, 4294967295, 0}));
  EXPECT_EQ(attribute(shape, "ID").type, NumberType::uint32);
  EXPECT_EQ(attribute(shape, "DIRECTION").type, NumberType::float32);
  EXPECT_EQ(attribute(shape, "DIRECTION").components, 3);
  expect_finding(shape, "left-out-attributes", "TANGENT: left out");
}

/// A triangle in a node that turns, scales unevenly and mirrors it: the normal stays across its edges, outside where it
/// was outside, and the direction stays along its edge.
TEST(GltfAttributes, NormalsAndDirectionsTurnWithTheirNode) {
  for (const char* scale : {"1,1,1", "2,3,5", "-2,3,5"}) {
    GlbBuilder file;
    const std::vector<float> corners = {0, 0, 0, 1, 0, 0.5, 0, 1, 0.25};
    file.array("VEC3", corners);
    file.array("VEC3", std::vector<float>{-0.5, -0.25, 1, -0.5, -0.25, 1, -0.5, -0.25, 1});
    file.array("VEC3", std::vector<float>{1, 0, 0.5, 1, 0, 0.5, 1, 0, 0.5});
    const RawShape shape = read(file.file(
        std::string(R"("nodes":[{"mesh":0,"translation":[7,8,9],"rotation":[0.5,0.5,-0.5,0.5],"scale":[)") + scale +
        R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"_DIRECTION":2}}]}])"));
    const std::vector<Point>& p = shape.mesh.points;
    const std::vector<std::int32_t>& c = shape.mesh.corners;
    const auto edge = [&](std::size_t a, std::size_t b) { return difference(p[b], p[a]); };
    const auto at = [&](int i) { return static_cast<std::size_t>(c[static_cast<std::size_t>(i)]); };
    const Point outside = unit(cross(edge(at(0), at(1)), edge(at(0), at(2))));
    const std::vector<double>&normal = attribute(shape, "normal").values,
          &direction = attribute(shape, "DIRECTION").values;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(normal[k], outside[k], 1e-6) << scale;
      EXPECT_NEAR(direction[k], edge(0, 1)[k], 1e-6) << scale;
    }
  }
}

/// Blender's exporter makes points stand, x z -y, and leaves directions, and puts another _ before their names.
TEST(GltfAttributes, DirectionsOfBlenderStandAsItsPointsDo) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC3", std::vector<float>{1, 2, 3, 1, 2, 3, 1, 2, 3});
  std::string bytes =
      file.file(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"__DIRECTION":1}}]}])");
  EXPECT_EQ(attribute(read(bytes), "DIRECTION").values, (std::vector<double>{1, 2, 3, 1, 2, 3, 1, 2, 3}));
  bytes = file.file(
      R"("asset":{"version":"2.0","generator":"Khronos glTF Blender I/O v3.4"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[
      {"attributes":{"POSITION":0,"__DIRECTION":1}}]}])");
  const RawShape shape = read(bytes);
  EXPECT_EQ(attribute(shape, "DIRECTION").values, (std::vector<double>{1, 3, -2, 1, 3, -2, 1, 3, -2}));
  expect_finding(shape, "blender-directions", "z up");
}

/// What a file says of its normals comes back with its form.
TEST(GltfAttributes, NormalsComeBackWithTheForm) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  mesh.set({"normal", 3, Domain::vertex, {0, 0, 1, 1, 0, 0, 0, 1, 0}});
  const std::string bytes = mesh_bytes(mesh, ".glb");
  const ShapeFile file = read_shape_bytes(bytes, "a.glb");
  EXPECT_TRUE(file.findings.empty());
  EXPECT_FALSE(file.mesh.find("normal"));
  EXPECT_EQ(mesh_bytes(as_in_file(*file.source, file.mesh), ".glb"), bytes);
}

TEST(GltfAttributes, OfFewerComponentsInTheFirstPart) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  file.array("VEC4", std::vector<float>{1, 0, 0, 0.5, 1, 0, 0, 0.5, 1, 0, 0, 0.5});
  const RawShape shape = read(file.file(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[
      {"attributes":{"POSITION":0,"COLOR_0":0}},{"attributes":{"POSITION":0,"COLOR_0":1}}]}])"));
  const Attribute& color = attribute(shape, "color");
  ASSERT_EQ(color.components, 4);
  EXPECT_EQ(color.values, (std::vector<double>{0, 0, 0, 1,   1, 0, 0, 1,   0, 1, 0, 1,  //
                                               1, 0, 0, 0.5, 1, 0, 0, 0.5, 1, 0, 0, 0.5}));
}

// --- parts ------------------------------------------------------------------------------------------------

/// A cube of six squares with vertices of their own, as exporters split them for their normals.
std::vector<float> split_cube() {
  std::vector<float> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {0.F, 1.F})
      for (int c = 0; c < 4; ++c) {
        float p[3];
        const float u = c == 1 || c == 2 ? 1 : 0, v = c >= 2 ? 1 : 0;
        p[axis] = side;
        p[(axis + 1) % 3] = side > 0 ? u : v;
        p[(axis + 2) % 3] = side > 0 ? v : u;
        points.insert(points.end(), p, p + 3);
      }
  return points;
}

TEST(GltfParts, NodesThatTouchStayParts) {
  GlbBuilder file;
  file.array("VEC3", split_cube());
  std::vector<std::uint16_t> indices;
  for (std::uint16_t q = 0; q < 24; q = static_cast<std::uint16_t>(q + 4))
    for (const int c : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(q + c));
  file.array("SCALAR", indices);
  const auto shape = [&](const std::string& move) {
    return read_shape_bytes(
        file.file(R"("nodes":[{"mesh":0,"name":"box"},{"mesh":0,"name":"box","translation":)" + move +
                  R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])"),
        "a.glb");
  };
  for (const char* move : {"[1,0,0]", "[1,1,0]", "[1,1,1]", "[0,0,-1]"}) {  // a face, an edge, a corner in common
    const ShapeFile touching = shape(move);
    const MeshReport report = describe(touching.mesh, {});
    EXPECT_EQ(report.components, 2u) << move;
    EXPECT_NEAR(report.volume, 2, 1e-12) << move;
    EXPECT_EQ(touching.mesh.points.size(), 16u) << move;
    const Attribute* object = touching.mesh.find("object");
    ASSERT_TRUE(object);
    EXPECT_EQ(object->labels, (std::vector<std::string>{"box", "box.2"}));
    EXPECT_EQ(object->domain, Domain::face);
  }
}

TEST(GltfParts, TheOnlyObjectNamesTheShape) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  const auto name = [&](const std::string& nodes, const std::string& mesh) {
    const std::string meshes = R"("meshes":[{)" + mesh + R"("primitives":[{"attributes":{"POSITION":0}}]}])";
    return read_shape_bytes(file.file(R"("nodes":[)" + nodes + "]," + meshes), "a.glb").name;
  };
  EXPECT_EQ(name(R"({"mesh":0,"name":"Beast"})", R"("name":"Skin",)"), "Beast");
  EXPECT_EQ(name(R"({"mesh":0})", R"("name":"Skin",)"), "Skin");
  EXPECT_EQ(name(R"({"mesh":0})", ""), "");
  EXPECT_EQ(name(R"({"mesh":0,"name":"a"},{"mesh":0,"name":"b","translation":[0,0,1]})", ""), "");
  EXPECT_EQ(read_shape_bytes("o Beast\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").name, "Beast");
  EXPECT_EQ(read_shape_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").name, "");
}

TEST(GltfParts, MaterialsAreLabelsOfFaces) {
  GlbBuilder file;
  file.array("VEC3", triangle);
  const RawShape shape =
      read(file.file(R"("nodes":[{"mesh":0}],"materials":[{"name":"Fur"},{}],"meshes":[{"primitives":[
      {"attributes":{"POSITION":0},"material":1},{"attributes":{"POSITION":0},"material":0},
      {"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"material":0}]}])"));
  const Attribute& material = attribute(shape, "material");
  EXPECT_EQ(material.labels, (std::vector<std::string>{"material 1", "Fur", ""}));
  EXPECT_EQ(material.values, (std::vector<double>{0, 1, 2, 1}));
}

TEST(GltfFiles, DataUrisAndNamesWithSpaces) {
  const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,
      "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}]})";
  expect_points(read(text), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const auto with = [&](const char* from, const char* to) {
    std::string changed = text;
    return changed.replace(changed.find(from), std::strlen(from), to);
  };
  test::expect_input_error([&] { read(with("base64,AAAA", "base64,A!AA")); }, "buffer 0 has data that are no base64");
  test::expect_input_error([&] { read(with("data:", "https://x.org/")); }, "only files beside this one");
  test::expect_input_error([&] { read(with("\"byteLength\":36,", "\"byteLength\":37,")); },
                           "buffer 0 has 36 of 37 bytes");
}

}  // namespace
}  // namespace pelage
