#include <pelage/grow.h>
#include <pelage/io.h>

#include <cmath>

#include "api_support.h"

namespace pelage::api {
namespace {

const char* const one_stage = "[stage]\nmodel = \"turing\"\nsize = 0.4\nuntil = 1000\n";
const char* const two_stages = R"(
stage = [ { name = "large", model = "turing", size = 0.5, steps = 6 },
          { name = "small", model = "turing", size = 0.4, steps = 8, initial = { b = "4 + 0.1*large.b" } } ]
)";

TriangleMesh sphere() { return load_shape("builtin:sphere?n=162"); }

Growth start(const std::string& recipe = one_stage, const Progress& progress = {}) {
  return {sphere(), parse_recipe(recipe, "test"), progress};
}

const Attribute& color(const TriangleMesh& mesh) { return *mesh.find("color"); }

bool same(const Attribute& a, const Attribute& b) {
  return a.name == b.name && a.components == b.components && a.domain == b.domain && a.values == b.values;
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.attributes.size(), b.attributes.size());
  for (std::size_t i = 0; i < a.attributes.size(); ++i) EXPECT_TRUE(same(a.attributes[i], b.attributes[i])) << i;
}

TEST(Grow, SlicesOfAnySizeMakeTheSameCoat) {
  for (const char* recipe : {one_stage, two_stages}) {
    Growth whole = start(recipe), sliced = start(recipe);
    whole.advance(100);
    sliced.advance(40);
    sliced.dress();
    sliced.advance(60);
    EXPECT_EQ(whole.checkpoint(), sliced.checkpoint());
  }
}

TEST(Grow, TheFunctionIsTheObjectToItsEnd) {
  Growth growth = start(two_stages);
  EXPECT_EQ(growth.stage().name, "large");
  EXPECT_EQ(growth.stage().count, 2u);
  while (!growth.done()) growth.advance(3);
  EXPECT_EQ(growth.fraction(), 1);
  EXPECT_EQ(growth.stage().number, 1u);
  EXPECT_EQ(growth.stage().name, "small");
  EXPECT_EQ(growth.summary().steps, 8);
  EXPECT_EQ(growth.summary().status, RunStatus::steps_reached);
  expect_same(grow(sphere(), parse_recipe(two_stages, "test")), growth.dress());
}

TEST(Grow, ACheckpointGoesOnWithTheSameBits) {
  Growth growth = start(two_stages), other = start(two_stages);
  growth.advance(9);
  other.advance(2);
  other.dress();
  other.restore(growth.checkpoint());
  expect_same(other.dress(), growth.dress());
  growth.advance(3);
  other.advance(3);
  EXPECT_EQ(other.checkpoint(), growth.checkpoint());
}

TEST(Grow, AForeignCheckpointChangesNothing) {
  Growth growth = start(), other = start(two_stages);
  growth.advance(3);
  const std::string before = growth.checkpoint();
  EXPECT_EQ(fault_of([&] { growth.restore(other.checkpoint()); }), 3);
  EXPECT_EQ(fault_of([&] { growth.restore("nonsense"); }), 3);
  EXPECT_EQ(growth.checkpoint(), before);
}

TEST(Grow, AnotherRampChangesTheColourAlone) {
  Growth growth = start();
  growth.advance(20);
  const TriangleMesh coat = growth.dress();
  Look look;
  look.ramp.value = "reef";
  const TriangleMesh other = growth.dress(look);
  EXPECT_NE(color(coat).values, color(other).values);
  TriangleMesh with_first_color = other;
  with_first_color.set(color(coat));
  expect_same(with_first_color, coat);

  Growth fresh = start();
  fresh.restore(growth.checkpoint());
  expect_same(fresh.dress(look), other);
}

TEST(Grow, WhatIsKeptForTheNextLookIsMadeAnewWhenItChanges) {
  Growth growth = start();
  growth.advance(5);
  const TriangleMesh before = growth.dress();
  Look look;
  look.detail = 1;
  const TriangleMesh fine = growth.dress(look);
  look.flat = true;
  const TriangleMesh flat = growth.dress(look);
  EXPECT_GT(fine.points.size(), before.points.size());
  EXPECT_NE(fine.points, flat.points);
  look.layers = {{Given<std::string>{"#ff0000", {}}, {}, {}, 0, 1, Given<std::string>{"mean_curvature > 0", {}}}};
  EXPECT_NE(fault_of([&] { growth.dress(look); }), 0);  // no such quantity
  look.layers[0].opacity->value = "k1 > 0";
  EXPECT_NE(color(growth.dress(look)).values, color(flat).values);
  expect_same(growth.dress(), before);
  growth.advance(5);
  EXPECT_NE(growth.dress().find("b")->values, before.find("b")->values);
}

TEST(Grow, FieldsAreThoseAtTheVertices) {
  Recipe recipe = parse_recipe(
      "[stage]\nmodel = \"turing\"\nsize = 1.0\nsteps = 0\nmethod = \"linear\"\ninitial = { a = \"x\", b = \"2 + y*z\" "
      "}\n"
      "[look]\nkeep-shape = true\ndetail = 0\n",
      "test");
  const TriangleMesh shape = sphere();
  const Growth growth(shape, recipe);
  const TriangleMesh coat = growth.dress();
  const std::vector<Growth::Field> fields = growth.fields();
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[0].name, "a");
  EXPECT_EQ(fields[1].name, "b");
  for (std::size_t v = 0; v < shape.points.size(); ++v) {
    const Point& p = shape.points[v];
    EXPECT_EQ(coat.points[v], p);
    EXPECT_NEAR(fields[0].values[v], p[0], 1e-12);
    EXPECT_NEAR(fields[1].values[v], 2 + p[1] * p[2], 1e-12);
  }
  EXPECT_EQ(fields[1].values, coat.find("b")->values);
}

TEST(Grow, FieldsOfEarlierStagesKeepTheirNames) {
  Growth growth = start(two_stages);
  while (!growth.done()) growth.advance(100);
  std::vector<std::string> names;
  for (const Growth::Field& field : growth.fields()) {
    names.push_back(field.name);
    EXPECT_EQ(field.values.size(), growth.dress().points.size());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"large.a", "large.b", "a", "b"}));
}

/// Asks to stop when it is called for the nth time with something that begins like that.
Progress stop_at(const std::string& begin, int n) {
  return [begin, n](std::string_view what, double fraction) mutable {
    EXPECT_LE(fraction, 1);
    return !what.starts_with(begin) || --n != 0;
  };
}

TEST(Grow, WhatIsCancelledCanGoOn) {
  Growth whole = start(two_stages);
  whole.advance(100);
  for (const Progress& progress : {stop_at("growing", 4), stop_at("growing", 11), stop_at("stage small", 1)}) {
    Growth growth = start(two_stages, progress);
    EXPECT_EQ(fault_of([&] { growth.advance(100); }), 130);
    EXPECT_FALSE(growth.done());
    EXPECT_GT(growth.dress().points.size(), 0u);
    growth.advance(100);
    EXPECT_EQ(growth.checkpoint(), whole.checkpoint());
  }
  Growth growth = start(two_stages, stop_at("growing", 4));
  EXPECT_EQ(fault_of([&] { growth.advance(100); }), 130);
  EXPECT_EQ(growth.summary().steps, 3);
  EXPECT_EQ(fault_of([] { start(one_stage, [](std::string_view, double) { return false; }); }), 130);
}

TEST(Grow, AModelAsTextIsTheModel) {
  const std::string text = bytes_of(PELAGE_SOURCE_DIR "/models/turing.toml");
  for (const char* variant : {"", ":production"}) {
    Recipe recipe = parse_recipe(one_stage, "test");
    recipe.stages[0].model.value = std::string("turing") + variant;
    Growth built_in(sphere(), recipe);
    recipe.models["mine"].text = text;
    recipe.stages[0].model.value = std::string("mine") + variant;
    Growth mine(sphere(), recipe);
    built_in.advance(20);
    mine.advance(20);
    EXPECT_EQ(built_in.fields()[1].values, mine.fields()[1].values);
  }
}

TEST(Grow, FaultsOfAModelAsTextHaveTheirPlace) {
  Recipe recipe;
  recipe.models["mine"].text = "name = \"mine\"\n[species.u]\ndiffusion = \"1\"\nrate = \"1 - w\"\n";
  recipe.stages[0].model.value = "mine";
  try {
    Growth(sphere(), recipe);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_EQ(error.where().file, "mine");
    EXPECT_EQ(error.where().line, 4);
  }
  recipe.stages[0].model.value = "yours";
  EXPECT_EQ(fault_of([&] { Growth(sphere(), recipe); }), 2);
}

/// Two cones on a common rim of n vertices.
TriangleMesh double_cone(std::int32_t n) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 1}, {0, 0, -1}};
  for (std::int32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
    const std::int32_t here = 2 + i, next = 2 + (i + 1) % n;
    mesh.triangles.push_back({0, here, next});
    mesh.triangles.push_back({1, next, here});
  }
  return mesh;
}

TEST(Grow, ALinearFallbackIsAWarning) {
  Recipe recipe;
  recipe.stages[0].size = Given<Length>{{1}, {}};
  recipe.stages[0].steps = 1;
  EXPECT_EQ(Growth(double_cone(100), recipe).warnings().size(), 0u);
  const Growth growth(double_cone(300), recipe);
  ASSERT_EQ(growth.warnings().size(), 1u);
  EXPECT_NE(growth.warnings()[0].find("linear"), std::string::npos) << growth.warnings()[0];
}

TEST(Grow, ACoatWithoutAPatternSaysWhy) {
  Recipe recipe =
      parse_recipe("[stage]\nmodel = \"turing\"\nsize = 0.4\nsteps = 2\ninitial = { a = \"4\", b = \"4\" }\n", "test");
  Growth growth(sphere(), recipe);
  growth.advance(2);
  EXPECT_TRUE(growth.uniform());
  EXPECT_NE(growth.why_uniform(), "");
  growth = start();
  growth.advance(60);
  EXPECT_FALSE(growth.uniform());
  EXPECT_EQ(growth.why_uniform(), "");
}

TEST(Grow, EveryBuiltInRecipeIsLoaded) {
  EXPECT_GT(recipe_names().size(), 5u);
  for (const std::string& name : recipe_names()) EXPECT_FALSE(load_recipe(name).stages.empty()) << name;
  EXPECT_EQ(fault_of([] { load_recipe("no such coat"); }), 2);
  EXPECT_EQ(fault_of([] { load_recipe("no/such/file.toml"); }), 3);
}

}  // namespace
}  // namespace pelage::api
