#include "catalog/missing_attribute.h"

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "shape/generators.h"

namespace pelage {
namespace {

TriangleMesh sphere_with(const std::vector<std::pair<std::string, int>>& attributes) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  for (const auto& [name, components] : attributes)
    mesh.attributes.push_back({name, components, Domain::vertex,
                               std::vector<double>(mesh.points.size() * static_cast<std::size_t>(components), 0.5)});
  return mesh;
}

/// What binding says of a map of a parameter on such a shape; "" if nothing.
std::string fault(const std::string& formula, const TriangleMesh& shape) {
  Recipe recipe = parse_recipe("[stage]\nmodel = \"turing\"\nsize-map = \"" + formula + "\"\n", "r.toml");
  try {
    make_program(recipe, shape);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(MissingAttribute, NamesWhatThereIsAndWhyItMayBeMissing) {
  const TriangleMesh mesh = sphere_with({{"color", 4}, {"flow", 3}, {"weight", 1}, {"uv", 2}});
  const std::string said = fault("attribute(Paint)", mesh);
  EXPECT_TRUE(has(said, "r.toml:3:")) << said;
  EXPECT_TRUE(has(said, "no vertex attribute \"Paint\"; it has color, flow_1, ..., uv_1, ..., weight;")) << said;
  EXPECT_TRUE(has(said, "a painted colour arrives as \"color\"")) << said;
  EXPECT_TRUE(has(said, "begin with _")) << said;
  EXPECT_FALSE(has(fault("attribute(Paint)", sphere_with({{"weight", 1}})), "arrives as"));
  EXPECT_TRUE(has(fault("attribute(Paint)", sphere_with({})), "it has none"));
}

TEST(MissingAttribute, SplitsVectors) {
  const TriangleMesh mesh = sphere_with({{"Paint", 4}});
  EXPECT_TRUE(
      has(fault("attribute(paint)", mesh), "\"Paint\" has 4 components, attribute(Paint_1) to attribute(Paint_4)"));
  EXPECT_EQ(fault("attribute(PAINT_4)", mesh), "");
}

TEST(MissingAttribute, SuggestsWhatIsNear) {
  EXPECT_TRUE(has(fault("attribute(wieght)", sphere_with({{"weight", 1}})), "did you mean \"weight\"?"));
}

/// Layers read an attribute that is called like a species under its name in the coat.
TEST(MissingAttribute, KnowsWhatSpeciesHide) {
  Recipe recipe = parse_recipe(
      "[stage]\nmodel = \"turing\"\n[[look.layers]]\ncolor = \"#ffffff\"\nopacity = \"attribute(input_b)\"\n",
      "r.toml");
  EXPECT_NO_THROW(make_program(recipe, sphere_with({{"b", 1}})));
  EXPECT_THROW(make_program(recipe, sphere_with({{"c", 1}})), Error);
}

}  // namespace
}  // namespace pelage
