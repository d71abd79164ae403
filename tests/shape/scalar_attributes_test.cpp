#include "shape/scalar_attributes.h"

#include <gtest/gtest.h>

#include "base/srgb.h"
#include "shape/refine.h"
#include "shape/texture.h"

namespace pelage {
namespace {

/// A square of two triangles.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Half of white, painted on the shape and as an image, is one half in formulas, and as light what sRGB says.
TEST(ScalarAttributes, OneRuleForColoursAndImages) {
  TriangleMesh mesh = square();
  const double light = linear_from_srgb(0.5);
  Attribute color{"color", 4, Domain::vertex, {}};
  for (int v = 0; v < 4; ++v) color.values.insert(color.values.end(), {light, 1, 0, 0.25});
  mesh.set(color);
  const VertexAttributes painted = scalar_attributes(mesh);
  const Texture image{"color", 1, 1,
                      std::make_shared<const std::vector<std::uint16_t>>(std::vector<std::uint16_t>{32768, 65535, 0})};
  const Attribute uv{"uv", 2, Domain::vertex, std::vector<double>(8, 0.5)};
  const VertexAttributes seen = texture_attributes(image, mesh.triangles, 4, uv);
  EXPECT_NEAR(painted.at("color_1")[0], 0.5, 1e-12);
  EXPECT_NEAR(painted.at("color_linear_1")[0], light, 1e-12);
  EXPECT_NEAR(painted.at("color")[0], 0.2126 * 0.5 + 0.7152, 1e-12);
  EXPECT_EQ(painted.at("color_4")[3], 0.25);
  for (const std::string& name : color_names("color"))
    for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(painted.at(name)[v], seen.at(name)[v], 1e-4) << name;
}

TEST(ScalarAttributes, CornersAndFacesAreMeans) {
  TriangleMesh mesh = square();
  mesh.set({"w", 1, Domain::corner, {1, 2, 3, 5, 6, 7}});
  mesh.set({"material", 1, Domain::face, {0, 1}, NumberType::int32, {"fur", "skin"}});
  mesh.set({"flow", 2, Domain::vertex, {1, 2, 3, 4, 5, 6, 7, 8}});
  const VertexAttributes values = scalar_attributes(mesh);
  EXPECT_EQ(values.at("w"), (std::vector<double>{3, 2, 4.5, 7}));
  EXPECT_EQ(values.at("material"), (std::vector<double>{0.5, 0, 0.5, 1}));
  EXPECT_EQ(values.at("flow_2"), (std::vector<double>{2, 4, 6, 8}));
}

/// Where triangles are split, faces hand on what they have, and integers between vertices become doubles.
TEST(ScalarAttributes, SplitTrianglesKeepThem) {
  TriangleMesh mesh = square();
  mesh.set({"material", 1, Domain::face, {4, 9}, NumberType::int32});
  mesh.set({"id", 1, Domain::vertex, {1, 2, 3, 16777217}, NumberType::int32});
  mesh.set({"even", 1, Domain::vertex, {0, 2, 4, 6}, NumberType::uint8});
  const TriangleMesh fine = split_at_midpoints(mesh);
  EXPECT_EQ(fine.find("material")->values, (std::vector<double>{4, 4, 4, 4, 9, 9, 9, 9}));
  EXPECT_EQ(fine.find("material")->type, NumberType::int32);
  EXPECT_EQ(fine.find("id")->type, NumberType::float64);
  EXPECT_EQ(fine.find("id")->values[3], 16777217);
  EXPECT_EQ(fine.find("even")->type, NumberType::uint8);
}

}  // namespace
}  // namespace pelage
