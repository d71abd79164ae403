#include "io/gltf_coat.h"

#include <gtest/gtest.h>

#include <cstring>

#include "io/glb_writer.h"
#include "io/gltf_reader.h"
#include "io/write_mesh.h"
#include "io/written_meshes.h"
#include "pelage/channel.h"
#include "pelage/io.h"

namespace pelage {
namespace {

/// A closed mesh with these values at its vertices, one after the other and again.
TriangleMesh with_channels(const std::vector<std::pair<Channel, std::vector<double>>>& channels) {
  TriangleMesh mesh = test::closed_mesh();
  mesh.attributes.clear();
  const std::size_t n = mesh.points.size();
  Attribute color{"color", 3, Domain::vertex, {}};
  for (std::size_t v = 0; v < n; ++v) color.values.insert(color.values.end(), {0.5, 0.25, 0.125});
  mesh.set(color);
  for (const auto& [channel, values] : channels) {
    Attribute a{std::string(kind_of(channel).attribute), 1, Domain::vertex, {}};
    for (std::size_t v = 0; v < n; ++v) a.values.push_back(values[v % values.size()]);
    mesh.set(a);
  }
  return mesh;
}

std::string json_of(const TriangleMesh& mesh) {
  const std::string bytes = encode_glb(mesh);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return bytes.substr(20, length);
}

bool has(const std::string& json, const std::string& text) { return json.find(text) != std::string::npos; }

TEST(GltfCoat, ConstantsAreFactorsAndNoAttributes) {
  const TriangleMesh mesh = with_channels({{Channel::roughness, {0.25}}, {Channel::metalness, {1}}});
  const std::string json = json_of(mesh);
  EXPECT_TRUE(has(json, "\"roughnessFactor\":0.25")) << json;
  EXPECT_FALSE(has(json, "metallicFactor")) << json;  // 1 is what glTF takes where nothing is said
  EXPECT_FALSE(has(json, "_MATERIAL"));
  EXPECT_FALSE(has(json, "extensionsUsed"));
  EXPECT_TRUE(losses(mesh, ".glb").empty());
}

TEST(GltfCoat, WhatDiffersIsAMeanAndAnAttribute) {
  const TriangleMesh mesh = with_channels({{Channel::roughness, {0.25, 0.75}}, {Channel::height, {0, 1}}});
  const std::string json = json_of(mesh);
  ASSERT_EQ(mesh.points.size() % 2, 0U);
  EXPECT_TRUE(has(json, "\"roughnessFactor\":0.5")) << json;
  EXPECT_TRUE(has(json, "_MATERIAL_ROUGHNESS"));
  EXPECT_TRUE(has(json, "_MATERIAL_HEIGHT"));
  ASSERT_EQ(losses(mesh, ".glb").size(), 1U);
  EXPECT_TRUE(has(losses(mesh, ".glb")[0], "how material_roughness differs")) << losses(mesh, ".glb")[0];
  EXPECT_TRUE(has(losses(mesh, ".glb")[0], "material_height"));
}

TEST(GltfCoat, OpacityGoesWithTheColours) {
  const TriangleMesh mesh = with_channels({{Channel::opacity, {0.5, 1}}});
  const std::string bytes = encode_glb(mesh), json = json_of(mesh);
  EXPECT_TRUE(has(json, "\"alphaMode\":\"BLEND\"")) << json;
  const TriangleMesh back = test::raw_mesh(read_gltf(bytes, "a.glb"));
  const Attribute* color = back.find("color");
  ASSERT_TRUE(color && color->components == 4);
  EXPECT_EQ(std::vector<double>(color->values.begin(), color->values.begin() + 4),
            (std::vector<double>{0.5, 0.25, 0.125, 0.5}));
  EXPECT_TRUE(losses(mesh, ".glb").empty());
}

TEST(GltfCoat, GlassAndStrongLightAreExtensions) {
  const std::string glass = json_of(with_channels({{Channel::transmission, {0.75}}, {Channel::thickness, {0.5}}}));
  EXPECT_TRUE(has(glass, "\"KHR_materials_transmission\":{\"transmissionFactor\":0.75}")) << glass;
  EXPECT_TRUE(has(glass, "\"KHR_materials_volume\":{\"thicknessFactor\":0.5}")) << glass;
  EXPECT_TRUE(has(glass, "\"extensionsUsed\":[\"KHR_materials_transmission\",\"KHR_materials_volume\"]")) << glass;
  const std::string weak = json_of(with_channels({{Channel::emission, {1}}}));
  EXPECT_TRUE(has(weak, "\"emissiveFactor\":[0.5,0.25,0.125]")) << weak;
  EXPECT_FALSE(has(weak, "extensions"));
  const std::string strong = json_of(with_channels({{Channel::emission, {8}}}));
  EXPECT_TRUE(has(strong, "\"emissiveFactor\":[1.0,0.5,0.25]")) << strong;
  EXPECT_TRUE(has(strong, "\"emissiveStrength\":4.0")) << strong;
}

}  // namespace
}  // namespace pelage
