// The same shape elsewhere, in another unit, or in other numbers gets the same coat.

#include <pelage/grow.h>
#include <pelage/io.h>

#include <algorithm>
#include <cmath>

#include "api_support.h"
#include "support/reordered.h"

namespace pelage::api {
namespace {

using testing::placed;
using testing::Reordered;
using testing::reordered;

constexpr Point utm = {431250.125, 5412875.25, 310.5};

Recipe recipe_of(const std::string& text) {
  Recipe recipe = parse_recipe(text, "place.toml");
  recipe.look.keep_shape = true;
  recipe.look.detail = 0;
  return recipe;
}

/// At the vertices of the shape.
std::vector<double> grown(const TriangleMesh& shape, const Recipe& recipe) {
  Growth growth(shape, recipe);
  while (!growth.done()) growth.advance(50);
  std::vector<double> values = growth.fields().back().values;
  values.resize(shape.points.size());  // those of finer levels follow
  return values;
}

/// The largest difference, relative to the range of values.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  const auto [low, high] = std::minmax_element(a.begin(), a.end());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  EXPECT_GT(*high - *low, 1e-3) << "nothing has grown";
  return most / (*high - *low);
}

void expect_same_coat(const std::string& shape, const std::string& text, double tolerance) {
  SCOPED_TRACE(shape + "\n" + text);
  const Recipe recipe = recipe_of(text);
  const TriangleMesh mesh = load_shape(shape);
  const std::vector<double> plain = grown(mesh, recipe);
  EXPECT_LT(difference(plain, grown(placed(mesh, 1, {10, 0, 0}), recipe)), tolerance) << "moved";
  EXPECT_LT(difference(plain, grown(placed(mesh, 1000, {}), recipe)), tolerance) << "in millimetres";
  EXPECT_LT(difference(plain, grown(placed(mesh, 1, utm), recipe)), tolerance) << "georeferenced";
  const Reordered other = reordered(mesh, 5);
  const std::vector<double> shuffled = grown(other.mesh, recipe);
  std::vector<double> back;
  for (const std::int32_t v : other.vertex) back.push_back(shuffled[static_cast<std::size_t>(v)]);
  EXPECT_LT(difference(plain, back), tolerance) << "shuffled";
}

TEST(Place, SpotsFromNoise) {
  for (const char* shape : {"builtin:sphere?n=642", "builtin:animal?n=800", "builtin:plane?n=400"})
    expect_same_coat(shape, "[stage]\nmodel = \"turing\"\nsize = 0.12\nuntil = 30\n", 1e-3);
}

TEST(Place, OtherMethodsAndSteppers) {
  for (const char* method : {"loop", "linear"})
    expect_same_coat(
        "builtin:torus?n=700",
        "[stage]\nmodel = \"schnakenberg\"\nsize = 0.2\nsteps = 40\nmethod = \"" + std::string(method) + "\"\n", 1e-3);
}

/// On a sphere many fields of directions are as smooth as each other.
TEST(Place, Directions) {
  for (const char* shape : {"builtin:sphere?n=642", "builtin:animal?n=800"})
    expect_same_coat(shape, "[stage]\nmodel = \"witkin-kass-stripes\"\nsize = 0.15\nsteps = 30\n", 1e-2);
}

TEST(Place, RandomPointsAndWhiteNoise) {
  expect_same_coat(
      "builtin:torus?n=700",
      "[stage]\nmodel = \"turing\"\nsize = 0.15\nsteps = 20\npoints = 0.1\n"
      "initial = { a = \"4 + 0.3*if(points < 0.5, 1, 0)\", b = \"4 + 0.2*uniform(0, 1) + 0.1*normal(0, 1)\" }\n",
      1e-3);
}

}  // namespace
}  // namespace pelage::api
