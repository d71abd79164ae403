#include "catalog/brushes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/bind.h"
#include "pelage/grow.h"
#include "pelage/io.h"

namespace pelage {
namespace {

constexpr const char* painted = R"(
[[brush]]
name = "bald"
[[brush.stroke]]
radius = "0.5u"
hardness = 1
points = [[0, 0, 1]]
[[brush.stroke]]
radius = "0.2u"
value = 0.25
hardness = 1
points = [[0, 0, 1]]
[[stage]]
model = "turing:production"
size = 0.3
steps = 5
mask = "attribute(bald) > 0.5"
)";

TEST(Brushes, AreAttributesOfTheShape) {
  const Program program = make_program(parse_recipe(painted, "r.toml"), load_shape("builtin:sphere?n=2562"));
  const Attribute* bald = program.shape->find("bald");
  ASSERT_NE(bald, nullptr);
  for (std::size_t v = 0; v < program.shape->points.size(); ++v) {
    const Point& p = program.shape->points[v];
    const double distance = std::hypot(p[0], p[1], p[2] - 1);
    if (std::abs(distance - 0.5) < 1e-9 || std::abs(distance - 0.2) < 1e-9) continue;
    EXPECT_EQ(bald->values[v], distance < 0.2 ? 0.25 : distance < 0.5 ? 1 : 0) << distance;
  }
}

TEST(Brushes, MasksHoldWhatIsPainted) {
  const TriangleMesh coat = grow(load_shape("builtin:sphere?n=2562"), parse_recipe(painted, "r.toml"));
  const Attribute& b = *coat.find("b");
  const double ground = 4;
  std::size_t held = 0;
  for (std::size_t v = 0; v < coat.points.size(); ++v) {
    const Point& p = coat.points[v];
    const double distance = std::hypot(p[0], p[1], p[2] - 1);
    if (distance > 0.3 && distance < 0.4) held += std::abs(b.values[v] - ground) < 1e-6;
    if (distance > 1) {
      EXPECT_NE(b.values[v], ground);
    }
  }
  EXPECT_GT(held, 20U);
}

TEST(Brushes, ComeToCellsAndVolumes) {
  const std::string text = std::string(painted).replace(std::string(painted).find("size = 0.3"), 10, "size = 0.5");
  for (const char* method : {"cells", "tets"}) {
    const Recipe recipe = parse_recipe(text + "method = \"" + method + "\"\n", "r.toml");
    const Program program = make_program(recipe, load_shape("builtin:sphere?n=642"));
    const Attribute* bald = program.shape->find("bald");
    ASSERT_NE(bald, nullptr) << method;
    EXPECT_GT(*std::ranges::max_element(bald->values), 0.6) << method;
    EXPECT_EQ(*std::ranges::min_element(bald->values), 0) << method;
  }
}

std::string message_of(const std::string& recipe, const TriangleMesh& shape) {
  try {
    make_program(parse_recipe(recipe, "r.toml"), shape);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Brushes, FaultsAreLocated) {
  const auto with = [](const std::string& name, const std::string& stroke) {
    return "[[brush]]\nname = \"" + name + "\"\n[[brush.stroke]]\n" + stroke + "\n[[stage]]\nmodel = \"turing\"\n";
  };
  const std::string stroke = "radius = 0.1\npoints = [[0, 0, 1]]";
  TriangleMesh shape = load_shape("builtin:sphere?n=642");
  EXPECT_EQ(message_of(with("fur", stroke), shape), "");
  EXPECT_NE(message_of(with("a", stroke), shape).find("r.toml:2"), std::string::npos);  // a species
  EXPECT_NE(message_of(with("my fur", stroke), shape).find("not a name"), std::string::npos);
  EXPECT_NE(message_of(with("fur", "radius = 0.1"), shape).find("points"), std::string::npos);
  EXPECT_NE(message_of(with("fur", "radius = 0.1\npoints = []"), shape).find("at least one point"), std::string::npos);
  EXPECT_NE(message_of(with("fur", "radius = 0.1\nhardness = 2\n" + stroke.substr(13)), shape).find("from 0 to 1"),
            std::string::npos);
  shape.set({"fur", 1, Domain::vertex, std::vector<double>(shape.points.size(), 0.0)});
  EXPECT_NE(message_of(with("fur", stroke), shape).find("already"), std::string::npos);
}

TEST(Brushes, SayWhereTheShapeIsTooCoarse) {
  const std::string fine =
      "[[brush]]\nname = \"fur\"\n[[brush.stroke]]\nradius = \"0.01u\"\npoints = [[0, 0, 1]]\n"
      "[[stage]]\nmodel = \"turing\"\nsize = 0.3\n";
  const Program program = make_program(parse_recipe(fine, "r.toml"), load_shape("builtin:sphere?n=642"));
  ASSERT_EQ(program.warnings.size(), 1U);
  EXPECT_NE(program.warnings[0].find("fur"), std::string::npos);
}

}  // namespace
}  // namespace pelage
