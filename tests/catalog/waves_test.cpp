// Waves of excitation on sheets: fronts that bend move by c - D K (Grindrod 1991; Keener, Tyson).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "catalog/bind.h"
#include "pelage/grow.h"
#include "run/run.h"
#include "shape/builtin_grids.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using WaveRun = Run;  // in a test, Run is a function of its own

constexpr double side = 8;  // of the sheet, in lengths of the model

/// Barkley's medium at rest but for an excited part of a closed grid whose longer side is `side`.
WaveRun excited(const std::string& shape, const std::string& where) {
  Recipe recipe = parse_recipe(
      "[stage]\nmodel = \"barkley\"\nuntil = 1.5\ninitial = { u = \"if(" + where + ", 1, 0)\", v = \"0\" }\n", "test");
  recipe.stages[0].unit = {{1 / side, Length::Unit::world}, {}};
  return WaveRun(make_program(recipe, builtin_grid(shape)));
}

/// How far the excitation reaches along the first axis [lengths of the model]: the last place where u is 1/2.
double reach(const Vector& u, Eigen::Index n) {
  Eigen::Index i = n - 1;
  while (i > 0 && u[i] < 0.5) --i;
  return side / static_cast<double>(n) * (static_cast<double>(i) + (u[i] - 0.5) / (u[i] - u[i + 1]));
}

struct Track {
  std::vector<double> time, place;

  /// Over the way from one place to another, by interpolation.
  double speed(double from, double to) const { return (to - from) / (when(to) - when(from)); }
  double when(double at) const {
    const auto k = static_cast<std::size_t>(std::ranges::lower_bound(place, at) - place.begin());
    const double share = (at - place[k - 1]) / (place[k] - place[k - 1]);
    return time[k - 1] + share * (time[k] - time[k - 1]);
  }
};

Track followed(WaveRun run, Eigen::Index n) {
  Track track;
  while (!run.done() && (track.place.empty() || track.place.back() < 0.85 * side)) {
    run.advance(1);
    const double place = reach(run.coefficients()[1], n);
    if (track.place.empty() || place > track.place.back()) {
      track.time.push_back(run.summary().time);
      track.place.push_back(place);
    }
  }
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  return track;
}

/// A straight front runs at c, circles of radius R at c - D / R.
TEST(Waves, FrontsAreSlowerTheMoreTheyBend) {
  constexpr Eigen::Index n = 200;
  const Track straight = followed(excited("builtin:line?n=200", "x < 0.1"), n),
              round = followed(excited("builtin:sheet?n=200", "x^2 + y^2 < 0.0225"), n);
  const double c = straight.speed(3, 6);
  // The cubic front at v = 0; what v rises to within it slows it down a little.
  EXPECT_NEAR(c / (std::sqrt(1 / (2 * 0.02)) * (1 - 2 * 0.06 / 0.75)), 1, 0.08);
  for (const double radius : {2.0, 3.0, 4.0, 5.5}) {
    const double expected = c - 1 / radius;
    EXPECT_NEAR(round.speed(radius - 0.5, radius + 0.5) / expected, 1, 0.05) << radius;
  }
}

// --- a scroll ring ---------------------------------------------------------------------------------------------

/// Oscillations of radius 1 that turn slower where they are small; both species diffuse alike.
constexpr const char* oscillating = R"(
name = "scroll"
wavelength = 10
[species.v]
diffusion = 1
rate = "(1 - u^2 - v^2)*v - 0.6*(u^2 + v^2)*u"
initial = "0"
[species.u]
diffusion = 1
rate = "(1 - u^2 - v^2)*u + 0.6*(u^2 + v^2)*v"
initial = "0"
[suggested]
step = 0.1
end = 14
)";

/// Both species are about 0 at the filament: the mean distance of these nodes from the z axis [world units].
double filament(const WaveRun& run, const std::function<bool(const Point&)>& in_plane) {
  double sum = 0, weight = 0;
  for (Index node = 0; node < run.space().unknowns(); ++node) {
    const Point& p = run.space().control()[static_cast<std::size_t>(node)];
    const double square = std::pow(run.coefficients()[0][node], 2) + std::pow(run.coefficients()[1][node], 2);
    if (square > 0.15 || !in_plane(p)) continue;
    sum += (0.15 - square) * std::hypot(p[0], p[1]);
    weight += 0.15 - square;
  }
  return weight > 0 ? sum / weight : 0;
}

/// The slope of R^2 over the time, in lengths of the model, once the wave has curled up.
double slope_of_square(WaveRun run, double length, const std::function<bool(const Point&)>& in_plane) {
  std::vector<double> time, square;
  while (!run.done()) {
    run.advance(2);
    const double r = filament(run, in_plane) * length;
    if (run.summary().time < 3 || r == 0) continue;
    time.push_back(run.summary().time);
    square.push_back(r * r);
  }
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  double mt = 0, ms = 0, tt = 0, ts = 0;
  const auto count = static_cast<double>(time.size());
  for (std::size_t k = 0; k < time.size(); ++k) mt += time[k] / count, ms += square[k] / count;
  for (std::size_t k = 0; k < time.size(); ++k) {
    tt += (time[k] - mt) * (time[k] - mt);
    ts += (time[k] - mt) * (square[k] - ms);
  }
  return ts / tt;
}

Recipe ring(const std::string& initial, double length) {
  Recipe recipe = parse_recipe("[stage]\nmodel = \"scroll\"\nuntil = 14\ninitial = " + initial + "\n", "test");
  recipe.models["scroll"].text = oscillating;
  recipe.stages[0].unit = {{1 / length, Length::Unit::world}, {}};
  return recipe;
}

/// R(t)^2 = R0^2 - 2 D t where both species diffuse alike (Keener, Tyson 1992): a quarter of a ring, between mirrors.
TEST(Waves, ARingOfScrollsShrinksAsTheoryOfFilamentsSays) {
  constexpr double length = 20;
  const Recipe recipe = ring("{ u = \"tanh(20*(sqrt(x^2 + y^2) - 0.4))\", v = \"tanh(20*(z - 0.5))\" }", length);
  const auto in_plane = [](const Point& p) { return p[1] < 0.03; };
  EXPECT_NEAR(slope_of_square(WaveRun(make_program(recipe, builtin_grid("builtin:box?n=40"))), length, in_plane), -2,
              0.2);
}

/// The whole ring in a ball.
TEST(Waves, RingsInBallsShrinkLikewise) {
  constexpr double length = 14;
  Recipe recipe = ring("{ u = \"tanh(14*(sqrt(x^2 + y^2) - 0.57))\", v = \"tanh(14*z)\" }", length);
  recipe.stages[0].method = {"tets", {}};
  const TriangleMesh sphere = builtin_shape("builtin:sphere");
  EXPECT_NEAR(slope_of_square(WaveRun(make_program(recipe, sphere)), length, [](const Point&) { return true; }), -2,
              0.2);
}

}  // namespace
}  // namespace pelage
