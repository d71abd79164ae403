// The eighteen textures of figure 3 of Witkin and Kass (1991) as tiles: their directions, measured by the gradient, lie
// where the recipe's map says; and they have come to rest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "catalog/bind.h"
#include "pelage/grow.h"
#include "run/run.h"
#include "shape/builtin_grids.h"

namespace pelage {
namespace {

using std::numbers::pi;
using TileRun = Run;  // in a test, Run is a function of its own
constexpr std::int32_t tile_nodes = 112;

/// Angle of the first direction at a place of the box from -1 to 1 [rad].
using Map = std::function<double(double bx, double by)>;

struct Texture {
  const char* name;
  int directions;  ///< evenly spaced; 0: none
  Map map;
  double order;              ///< at least; five directions in a maze show on finer grids only
  double least_on, most_on;  ///< share of nodes where the reaction is on, of threshold models
};

double radial(double x, double y) { return std::atan2(y - 0.1, x - 0.1); }
double along(double, double) { return 0; }

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

const Texture textures[] = {
    {"reptile", 0, along, 0, 0.4, 0.6},
    {"giraffe", 0, along, 0, 0.55, 0.8},
    {"reticulated-giraffe", 0, along, 0, 0, 1},
    {"coral", 5, along, 0.1, 0.55, 0.8},
    {"scalloped", 1, [](double x, double) { return 0.9 * std::sin(16 * x); }, 0.8, 0.4, 0.6},
    {"spiral", 2, [](double x, double y) { return radial(x, y) + 0.785; }, 0.6, 0.45, 0.65},
    {"triweave", 3, along, 0.35, 0.5, 0.75},
    {"twisty-maze", 5, along, -0.05, 0.4, 0.6},
    {"replication", 3, along, 0.35, 0.5, 0.75},
    {"purple-thing", 1, radial, 0.7, 0.35, 0.6},
    {"sand", 1, along, 0.85, 0.4, 0.6},
    {"maze", 2, along, 0.3, 0.4, 0.6},
    {"zebra-haunch", 1,
     [](double x, double y) {
       return pi / 2 + 0.9 * smoothstep(0.35, -0.25, x) + 0.7 * smoothstep(-0.2, -0.7, x + 0.3 * y);
     },
     0.85, 0.4, 0.6},
    {"radial", 2, radial, 0.6, 0.45, 0.65},
    {"space-giraffe", 0, along, 0, 0.45, 0.65},
    {"zebra", 1, along, 0.85, 0.4, 0.6},
    {"stucco", 0, along, 0, 0.5, 0.75},
    {"beats-us", 2, [](double x, double y) { return 1.6 * std::sin(7 * x) * std::cos(5 * y); }, 0.55, 0.45, 0.65},
    {"weave", 2, along, 0.6, 0.45, 0.7},
};

class TileTextures : public testing::TestWithParam<Texture> {};

/// Mean of exp(2 i d (angle of the gradient - angle across the map)) by its square.
double order(const Vector& u, int directions, const Map& map) {
  const auto n = static_cast<std::int32_t>(std::lround(std::sqrt(u.size())));
  std::complex<double> sum = 0;
  double all = 0;
  const auto at = [&](std::int32_t i, std::int32_t j) { return u[(i + n) % n + n * ((j + n) % n)]; };
  for (std::int32_t j = 1; j + 1 < n; ++j)
    for (std::int32_t i = 1; i + 1 < n; ++i) {
      const std::complex<double> gradient(at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1));
      const double across = map(2.0 * i / (n - 1) - 1, 2.0 * j / (n - 1) - 1) + pi / 2;
      sum += std::norm(gradient) * std::polar(1.0, 2 * directions * (std::arg(gradient) - across));
      all += std::norm(gradient);
    }
  return sum.real() / all;
}

/// Of the highest and lowest difference p - q of a threshold model, by its rule.
double share_on(const TileRun& run) {
  const Model& model = run.stage_program().model;
  std::vector<std::size_t> p, q;
  for (std::size_t s = 0; s < model.species_count(); ++s) {
    if (model.species_name(s)[0] == 'p') p.push_back(s);
    if (model.species_name(s)[0] == 'q') q.push_back(s);
  }
  double rule = 0, threshold = 0;
  for (const ParameterSource& parameter : model.parameters()) {
    if (parameter.name == "rule") rule = parameter.value;
    if (parameter.name == "threshold") threshold = parameter.value;
  }
  double on = 0;
  for (Eigen::Index v = 0; v < run.space().unknowns(); ++v) {
    double highest = -1e300, lowest = 1e300;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const double d = run.coefficients()[p[k]][v] - run.coefficients()[q[k]][v];
      highest = std::max(highest, d);
      lowest = std::min(lowest, d);
    }
    on += rule < 0.5 ? highest > threshold : std::abs(highest) > std::abs(lowest);
  }
  return p.empty() ? 0.5 : on / static_cast<double>(run.space().unknowns());
}

/// The last stage has twelve nodes to its wavelength.
Recipe recipe_on_tile(const Texture& texture) {
  Recipe recipe = load_recipe(texture.name);
  for (Stage& stage : recipe.stages)
    stage.size = {{stage.size->value.value / recipe.stages.back().size->value.value * 12, Length::Unit::cells}, {}};
  return recipe;
}

TileRun grown(const Recipe& recipe) {
  TileRun run(make_program(recipe, builtin_grid("builtin:tile?n=112")));
  run.advance(1'000'000);
  return run;
}

void expect_texture(const Texture& texture, const TileRun& run) {
  ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  EXPECT_FALSE(run.uniform());
  const Vector& shown = run.coefficients()[run.coefficients().size() - 1];
  if (texture.directions > 0)
    EXPECT_GT(order(shown, texture.directions, texture.map), texture.order);
  else
    EXPECT_LT(std::abs(order(shown, 1, along)), 0.1);
  const double on = share_on(run);
  EXPECT_GT(on, texture.least_on);
  EXPECT_LT(on, texture.most_on);
}

TEST_P(TileTextures, FollowTheirMapsAndComeToRest) {
  const TileRun run = grown(recipe_on_tile(GetParam()));
  expect_texture(GetParam(), run);
  EXPECT_LT(run.summary().change, 0.15);  // per time in which morphogens decay
}

/// Those whose rates do not change with time.
std::vector<Texture> steady_textures() {
  std::vector<Texture> steady;
  for (const Texture& t : textures)
    if (!std::string_view(t.name).ends_with("giraffe") && std::string_view(t.name) != "stucco") steady.push_back(t);
  return steady;
}

class SteadyTextures : public testing::TestWithParam<Texture> {};

TEST_P(SteadyTextures, AreTheSameAtExactRest) {
  Recipe recipe = recipe_on_tile(GetParam());
  for (Stage& stage : recipe.stages) stage.stepper = {"sign-iteration", {}};
  const TileRun run = grown(recipe);
  expect_texture(GetParam(), run);
  EXPECT_EQ(run.summary().status, RunStatus::stationary);
  EXPECT_EQ(run.summary().change, 0);
}

/// Of five pairs together a wave across one of the directions feeds the mean by little more than a wave between two:
/// the maze of five directions needs e = 3, and a grid that does not bend its walls.
TEST(TwistyMaze, ShowsItsFiveDirections) {
  Recipe recipe = load_recipe("twisty-maze");
  recipe.stages[0].size = {{18, Length::Unit::cells}, {}};
  TileRun run(make_program(recipe, builtin_grid("builtin:tile?n=144")));
  run.advance(1'000'000);
  EXPECT_GT(order(run.coefficients().back(), 5, along), 0.1);
}

std::string name_of(const testing::TestParamInfo<Texture>& test) {
  std::string name = test.param.name;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, TileTextures, testing::ValuesIn(textures), name_of);
INSTANTIATE_TEST_SUITE_P(All, SteadyTextures, testing::ValuesIn(steady_textures()), name_of);

}  // namespace
}  // namespace pelage
