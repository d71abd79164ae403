#include "io/gltf_animation.h"

#include <gtest/gtest.h>

#include <cstring>

#include "io/gltf_chunks.h"
#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

TriangleMesh sphere(const std::vector<double>& color) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  mesh.set({"color", 3, Domain::vertex, color});
  return mesh;
}

std::vector<double> grey(std::size_t vertices, double value) { return std::vector<double>(3 * vertices, value); }

std::vector<float> floats(const GlbChunks& glb, std::size_t accessor) {
  const GltfText& a = glb.json["accessors"][accessor];
  const GltfText& view = glb.json["bufferViews"][a["bufferView"].get<std::size_t>()];
  std::vector<float> values(view["byteLength"].get<std::size_t>() / sizeof(float));
  std::memcpy(values.data(), glb.bytes.data() + view.value("byteOffset", std::size_t{0}),
              values.size() * sizeof(float));
  return values;
}

/// At the time of a frame the colour is what the frame says: the first one plus the targets with their weights.
TEST(GltfAnimation, AtItsTimeEveryFrameIsShown) {
  const std::vector<double> greys = {0.2, 0.9, 0.4};
  const TriangleMesh mesh = sphere(grey(162, greys[0]));
  std::vector<AnimationFrame> frames;
  for (const double g : greys) frames.push_back({mesh.points, grey(162, g)});
  const GlbChunks glb = glb_chunks(encode_animated_glb(mesh, frames, 0.5, true, {}));
  const GltfText& part = glb.json["meshes"][0]["primitives"][0];
  const GltfText& sampler = glb.json["animations"][0]["samplers"][0];
  const std::vector<float> time = floats(glb, sampler["input"]), weight = floats(glb, sampler["output"]);
  ASSERT_EQ(part["targets"].size(), 2U);
  EXPECT_EQ(time, (std::vector<float>{0, 0.5, 1, 1.5}));
  ASSERT_EQ(weight.size(), 8U);
  for (std::size_t key = 0; key < 4; ++key) {
    double shown = floats(glb, part["attributes"]["COLOR_0"])[0];
    for (std::size_t t = 0; t < 2; ++t)
      shown += static_cast<double>(weight[2 * key + t]) * floats(glb, part["targets"][t]["COLOR_0"])[0];
    EXPECT_NEAR(shown, greys[key % 3], 1e-6) << "key " << key;
  }
  for (const GltfText& target : part["targets"]) {
    const GltfText& still = glb.json["accessors"][target["POSITION"].get<std::size_t>()];
    EXPECT_EQ(still["count"], 162);
    EXPECT_FALSE(still.contains("bufferView"));  // zeros, by the standard
  }
  for (const auto& [name, accessor] : part["attributes"].items()) EXPECT_FALSE(name.starts_with("_FRAME")) << name;
}

/// Where z points up, places turn with the mesh.
TEST(GltfAnimation, PlacesMoveInTheAxesOfTheFile) {
  const TriangleMesh mesh = sphere(grey(162, 0.5));
  std::vector<AnimationFrame> frames(2, {mesh.points, grey(162, 0.5)});
  for (Point& p : frames[1].points) p[2] += 2;
  const GlbChunks glb = glb_chunks(encode_animated_glb(mesh, frames, 1, false, {.up = UpAxis::z}));
  const GltfText& target = glb.json["meshes"][0]["primitives"][0]["targets"][0];
  const std::vector<float> moved = floats(glb, target["POSITION"]);
  for (std::size_t v = 0; v < 162; ++v) {
    EXPECT_NEAR(moved[3 * v], 0, 1e-6);
    EXPECT_NEAR(moved[3 * v + 1], 2, 1e-6);
    EXPECT_NEAR(moved[3 * v + 2], 0, 1e-6);
  }
  const GltfText& range = glb.json["accessors"][target["POSITION"].get<std::size_t>()];
  EXPECT_NEAR(range["min"][1].get<double>(), 2, 1e-6);
}

TEST(GltfAnimation, RefusesWhatIsNone) {
  const TriangleMesh mesh = sphere(grey(162, 0.5));
  EXPECT_THROW(encode_animated_glb(mesh, {{mesh.points, grey(162, 0.5)}}, 1, false, {}), Error);
}

}  // namespace
}  // namespace pelage
