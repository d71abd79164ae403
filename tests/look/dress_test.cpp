#include "look/dress.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pelage {
namespace {

Attribute number(const std::string& name) { return {name, 1, Domain::vertex, {1, 2, 3}}; }

std::vector<std::string> names(const std::vector<Attribute>& attributes) {
  std::vector<std::string> list;
  for (const Attribute& a : attributes) list.push_back(a.name);
  std::ranges::sort(list);
  return list;
}

/// A triangle with the fields "large.b" and "b", whose shape had these attributes.
Tessellation triangle(const std::vector<std::string>& attributes) {
  Tessellation t;
  t.triangles = {{0, 1, 2}};
  t.samples.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  t.samples.normal = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  t.samples.fields = {{1, 2, 3}, {4, 5, 6}};
  for (const std::string& name : attributes) t.attributes.push_back(number(name));
  t.links = {{"TextureFile", "skin.png"}};
  return t;
}

Paint paint_with(bool fields) {
  Look look;
  look.fields = fields;
  return resolve_paint(look, {"large.b", "b"});
}

/// A coat may be the shape of the next one: what each of them found stays, one "input_" further.
TEST(Dress, EveryAttributeOfTheShapeStays) {
  const TriangleMesh coat =
      dress(triangle({"color", "b", "input_color", "large_b", "mask", "input_input_color", "input_mask"}),
            paint_with(true), {0, 0});
  EXPECT_EQ(
      names(coat.attributes),
      (std::vector<std::string>{"b", "color", "input_b", "input_color", "input_input_color", "input_input_input_color",
                                "input_large_b", "input_mask", "large_b", "mask", "normal"}));
  ASSERT_EQ(coat.links.size(), 1U);
  EXPECT_EQ(coat.links[0].file, "skin.png");
}

/// u_1, u_2 and u_3 are the vector u, which files hold as one attribute; formulas know the components.
TEST(Dress, ComponentsAreOneVector) {
  Tessellation t = triangle({"u"});
  t.samples.fields = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 0, 1}, {5, 5, 5}};
  Look look;
  look.channels[Channel::height] = {"norm(u)^2 + norm(large.w)", {}};
  const std::vector<std::string> species = {"large.w_1", "large.w_2", "large.w_3", "v_1", "b"};
  EXPECT_THROW(resolve_paint(look, species), Error) << "there is no u";
  look.channels[Channel::height] = {"norm(large.w)^2", {}};
  const TriangleMesh coat = dress(t, resolve_paint(look, species), {0, 0, 0, 0, 0});
  EXPECT_EQ(names(coat.attributes),
            (std::vector<std::string>{"b", "color", "large_w", "material_height", "normal", "u", "v_1"}));
  EXPECT_EQ(coat.find("large_w")->components, 3);
  EXPECT_EQ(coat.find("large_w")->values, (std::vector<double>{1, 4, 7, 2, 5, 8, 3, 6, 9}));
  EXPECT_DOUBLE_EQ(coat.find("material_height")->values[0], 1 + 16 + 49);
}

TEST(Dress, LeavesFieldsOutWhereTheLookSaysSo) {
  const TriangleMesh coat = dress(triangle({"color", "b"}), paint_with(false), {0, 0});
  EXPECT_EQ(names(coat.attributes), (std::vector<std::string>{"b", "color", "input_color", "normal"}));
  EXPECT_EQ(coat.find("b")->values, number("b").values);  // that of the shape
  EXPECT_EQ(coat.find("color")->values, dress(triangle({}), paint_with(true), {0, 0}).find("color")->values);
}

TEST(Dress, ChannelsAreAttributes) {
  Look look;
  look.channels[Channel::height] = {"b - 4", {}};
  look.channels[Channel::roughness] = {"attribute(input_b)/3", {}};
  Tessellation t = triangle({"b", "material_height"});
  t.samples.attributes["b"] = {1, 2, 3};
  t.samples.wavelength = 10;
  const TriangleMesh coat = dress(t, resolve_paint(look, {"large.b", "b"}), {0, 0});
  EXPECT_EQ(coat.find("material_height")->values, (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(coat.find("input_material_height")->values, number("").values);
  EXPECT_EQ(coat.find("material_roughness")->values, (std::vector<double>{1.0 / 3, 2.0 / 3, 1}));
  EXPECT_EQ(coat.find("material_metalness"), nullptr);
}

TEST(Dress, HeightsMoveVerticesWhereTheLookSaysSo) {
  Look look;
  look.channels[Channel::height] = {"b - 4", {}};
  look.displace = true;
  const TriangleMesh coat = dress(triangle({}), resolve_paint(look, {"large.b", "b"}), {0, 0});
  EXPECT_EQ(coat.points, (std::vector<Point>{{0, 0, 0}, {1, 0, 1}, {0, 1, 2}}));
  EXPECT_EQ(coat.find("material_height"), nullptr);
  const std::vector<double>& n = coat.find("normal")->values;  // of the plane z = x + 2 y
  EXPECT_NEAR(n[0] / n[2], -1, 1e-12);
  EXPECT_NEAR(n[1] / n[2], -2, 1e-12);
}

/// An attribute that is called like a species: layers know the species by its name, and the attribute as files do.
TEST(Dress, LayersReadWhatASpeciesHides) {
  Look look;
  look.layers.emplace_back();
  look.layers[0].color = {"#ffffff", {}};
  look.layers[0].opacity = {"attribute(input_b) == 2", {}};
  Tessellation t = triangle({"b"});
  t.samples.attributes["b"] = {1, 2, 3};
  const std::vector<double> color = dress(t, resolve_paint(look, {"large.b", "b"}), {0, 0}).find("color")->values;
  EXPECT_EQ(color[3], 1);
  EXPECT_NE(color[0], 1);
  EXPECT_NE(color[6], 1);
}

}  // namespace
}  // namespace pelage
