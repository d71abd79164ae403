// Figs 2 to 5 of Bajaj, Zhang, Xu 2008 with their literal parameters and lengths; docs/figures.md has their list.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/bind.h"
#include "catalog/models.h"
#include "discretise/surface_space.h"
#include "measure/node_pattern.h"
#include "pelage/analyse.h"
#include "react/kinetics.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using GrownRun = Run;  // in a test, Run is a function of its own

/// On the unit sphere, whose radius is 1 / `unit` in lengths of the model.
Recipe on_sphere(const std::string& model, double unit) {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  recipe.stages[0].unit = {{unit, Length::Unit::world}, {}};
  recipe.stages[0].interpolate = true;
  return recipe;
}

GrownRun started(const Recipe& recipe) { return GrownRun(make_program(recipe, builtin_shape("builtin:sphere?n=642"))); }

void set(Recipe& recipe, const std::string& name, double value) {
  recipe.stages[0].parameters.push_back({name, value, {}});
}

// --- Fig. 2 ------------------------------------------------------------------------------------------------------

/// Rates R = C2 u + C3 and diffusions C0 C1 at a few states, the species in the order a, b or u, v.
struct RatesAndDiffusions {
  std::vector<double> rates, diffusions;
};

RatesAndDiffusions values_of(const Model& model, const std::vector<std::string>& names) {
  constexpr std::size_t count = 5;
  const std::vector<Point> points(count, Point{0.3, 0.2, 0.1});
  const Kinetics kinetics(model, {.positions = points}, 1);
  const std::vector<std::vector<double>> value = {{0.5, 1.5, 4, 7, 2}, {2.5, 0.25, 4, 1, 3}};
  std::vector<const double*> u(2);
  std::vector<std::vector<double>> rate(2, std::vector<double>(count)), c0 = rate, c1 = rate;
  std::vector<double*> rates(2), c0s(2), c1s(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto as_named = static_cast<std::size_t>(std::ranges::find(names, model.species_name(i)) - names.begin());
    u[i] = value.at(as_named).data();
    rates[i] = rate[as_named].data();
    c0s[i] = c0[as_named].data();
    c1s[i] = c1[as_named].data();
  }
  kinetics.rates(u, 0.7, 0, count, rates);
  kinetics.diffusion(u, 0.7, 0, count, c0s, c1s);
  RatesAndDiffusions result;
  for (std::size_t i = 0; i < 2; ++i) {
    result.rates.insert(result.rates.end(), rate[i].begin(), rate[i].end());
    for (std::size_t k = 0; k < count; ++k) result.diffusions.push_back(c0[i][k] * c1[i][k]);
  }
  return result;
}

void expect_rows(const std::string& rows, const std::string& model, const Overrides& values,
                 const std::vector<std::string>& names) {
  const RatesAndDiffusions table = values_of(compile(parse_model("name = 'table'\n" + rows, "table.toml")), names),
                           shipped = values_of(compile(load_model(model), values), names);
  for (std::size_t k = 0; k < table.rates.size(); ++k) {
    EXPECT_NEAR(table.rates[k], shipped.rates[k], 1e-12 * (1 + std::abs(shipped.rates[k]))) << k;
    EXPECT_DOUBLE_EQ(table.diffusions[k], shipped.diffusions[k]) << k;
  }
}

TEST(BajajZhangXu, RowsOfFigure2AreTheTuringSystem) {
  expect_rows(
      "[species.a]\nC0 = 'Da'\nC1 = 1\nC2 = '-s*b'\nC3 = '16*s'\n"
      "[species.b]\nC0 = 'Db'\nC1 = 1\nC2 = 's*(a - 1)'\nC3 = '-s*beta'\n"
      "[parameters]\nDa = 0.125\nDb = 0.03125\ns = 0.05\nbeta = 12\n",
      "turing", {{"unevenness", 0}}, {"a", "b"});
}

/// As printed, without the loss -u.
TEST(BajajZhangXu, RowsOfFigure2AreTheForcedBrusselator) {
  const std::string rest =
      "C3 = 'c + beta'\n[species.v]\nC0 = 'delta'\nC1 = 1\nC2 = '-u^2'\nC3 = 'd*u'\n"
      "[parameters]\nc = 0.5\nd = 1.5\nGamma = 0.1\nomega = 1.69\ndelta = 5\nbeta = 0\n";
  const std::string first = "[species.u]\nC0 = 1\nC1 = 1\nC2 = '(1 + Gamma*cos(omega*t))*u*v - d";
  expect_rows(first + "'\n" + rest, "forced-brusselator", {{"loss", 0}, {"delta", 5}}, {"u", "v"});
  expect_rows(first + " - 1'\n" + rest, "forced-brusselator", {{"delta", 5}}, {"u", "v"});
}

/// As printed nothing balances the supply: without the drive u + v grows by c everywhere and for ever.
TEST(BajajZhangXu, TheForcedBrusselatorAsPrintedOnlyGrows) {
  EXPECT_EQ(analyse("forced-brusselator", {{"Gamma", 0}, {"loss", 0}}).regime, Regime::no_state);
  Recipe recipe = on_sphere("forced-brusselator:literal", 0.05);
  set(recipe, "Gamma", 0);
  recipe.stages[0].until = 3;
  recipe.stages[0].stepper = {"sbdf2", {}};
  GrownRun run = started(recipe);
  const auto amount = [&] { return run.amounts()[0] + run.amounts()[1]; };
  const double before = amount(), area = sum(Vector(*run.system().mass * Vector::Ones(run.space().unknowns())));
  while (!run.done()) run.advance(100);
  EXPECT_NEAR((amount() - before) / area, 0.5 * 3, 1e-4);
}

// --- Fig. 3 ------------------------------------------------------------------------------------------------------

std::size_t spots(const std::string& variant, double grainy) {
  Recipe recipe = on_sphere("turing:" + variant, 0.05);
  set(recipe, "grainy", grainy);
  GrownRun run = started(recipe);
  while (!run.done()) run.advance(100);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  const Vector& b = run.coefficients()[1];
  const PatternMeasures m = measure_nodes(run.space(), 2, {b.begin(), b.end()});
  EXPECT_EQ(m.above.parts, 1U);
  return m.below.parts;
}

/// All lengths are sqrt(Db/s), so that on a given surface the number of spots is that of s; a substrate by itself at
/// every point grows as many as a smooth one.
TEST(BajajZhangXu, SpotsOfFigure3AreAsManyAsSSays) {
  for (const double grainy : {0.0, 1.0}) {
    const auto a = static_cast<double>(spots("bajaj-3a", grainy)), b = static_cast<double>(spots("bajaj-3b", grainy)),
               c = static_cast<double>(spots("bajaj-3c", grainy));
    EXPECT_NEAR(b / a, 0.0375 / 0.025, 0.08 * 1.5) << grainy;
    EXPECT_NEAR(c / a, 0.05 / 0.025, 0.08 * 2) << grainy;
    // In triangles as wide as the marginal wave there would be this many; the finished ones lie further apart.
    const double length = 0.05 * 2 * std::numbers::pi * std::sqrt(0.03125 / 0.025);
    EXPECT_NEAR(a * std::sqrt(3) / 2 * length * length / (4 * std::numbers::pi), 0.77, 0.08);
  }
}

// --- Fig. 4 ------------------------------------------------------------------------------------------------------

/// With Da > Db no wave of a finite length outgrows the uniform state, whatever s, s1 and s0: not with J_aa > 0 either,
/// since then the larger eigenvalue falls with k.
TEST(BajajZhangXu, LinearTheoryOfFigure4AsPrintedHasNoWave) {
  for (const double s : {0.025, 0.05})
    for (const double s1 : {0.1, 0.75, 2.0, 5.0})
      for (const double s0 : {-0.1, 0.0, 0.5}) {
        const std::map<std::string, double> kinetics = {{"s", s}, {"s1", s1}, {"s0", s0}};
        auto printed = kinetics;
        printed.insert({{"Da", 0.125}, {"Db", 0.03125}});
        const Analysis analysis = analyse("fitzhugh-nagumo", printed);
        ASSERT_FALSE(analysis.states.empty());
        for (const Stability& state : analysis.states) EXPECT_FALSE(state.band_max) << s << " " << s1 << " " << s0;
      }
  EXPECT_TRUE(analyse("fitzhugh-nagumo").stability.band_max);  // with the diffusions exchanged
}

/// The same start: with the diffusions as printed all goes uniform, exchanged it is a labyrinth of two phases.
TEST(BajajZhangXu, Figure4GrowsWithTheDiffusionsExchangedOnly) {
  for (const std::string figure : {"a", "c"})
    for (const bool printed : {true, false}) {
      Recipe recipe = on_sphere("fitzhugh-nagumo:bajaj-4" + figure, 0.2);
      if (printed) {
        set(recipe, "Da", 0.125);
        set(recipe, "Db", 0.03125);
      }
      recipe.stages[0].until = 300;
      recipe.stages[0].stationary = 0;
      GrownRun run = started(recipe);
      while (!run.done()) run.advance(100);
      EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
      EXPECT_EQ(run.uniform(), printed) << figure;
    }
}

// --- Fig. 5 ------------------------------------------------------------------------------------------------------

/// Of u, looked at once in a period of the drive.
struct Strobes {
  std::vector<double> apart;  ///< how far u is from itself k = 1 .. 4 periods before: root mean squares over the
                              ///< surface and the last four periods, relative to that of u from its mean over them
  std::size_t cores = 0;      ///< around how many triangles the phase winds, in four periods of the drive
};

/// The phase of an oscillation whose quarters are `seen` is that of (u0 - u2) + i (u3 - u1).
std::size_t cores_of(const std::vector<Vector>& seen, const std::vector<Triangle>& triangles) {
  const Vector x = seen[0] - seen[2], y = seen[3] - seen[1];
  std::size_t cores = 0;
  for (const Triangle& t : triangles) {
    double turned = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      turned += std::atan2(x[a] * y[b] - y[a] * x[b], x[a] * x[b] + y[a] * y[b]);
    }
    cores += std::abs(turned) > std::numbers::pi;
  }
  return cores;
}

Strobes strobes(const std::string& variant, int periods, int steps_per_period, const Overrides& values = {},
                std::uint64_t seed = 1) {
  Recipe recipe = on_sphere("forced-brusselator" + variant, 0.05);
  for (const auto& [name, value] : values) set(recipe, name, value.value);
  recipe.stages[0].seed = seed;
  const double period = 2 * std::numbers::pi / 1.69;
  recipe.stages[0].step = period / steps_per_period;
  recipe.stages[0].until = 1e4;
  GrownRun run = started(recipe);
  std::vector<Vector> seen;
  for (int k = 0; k < periods; ++k) {
    run.advance(steps_per_period);
    seen.push_back(run.coefficients()[1]);
  }
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  Vector mean = Vector::Zero(seen[0].size());
  const auto last = static_cast<std::size_t>(periods) - 4;
  for (std::size_t n = last; n < last + 4; ++n) mean += 0.25 * seen[n];
  Strobes result{std::vector<double>(4, 0.0)};
  double moves = 0;
  for (std::size_t n = last; n < last + 4; ++n) {
    moves += (seen[n] - mean).squaredNorm();
    for (std::size_t k = 1; k <= 4; ++k) result.apart[k - 1] += (seen[n] - seen[n - k]).squaredNorm();
  }
  for (double& r : result.apart) r = std::sqrt(r / moves);
  const auto& surface = dynamic_cast<const SurfaceSpace&>(run.space());
  result.cores = cores_of({seen.end() - 4, seen.end()}, surface.discretisation().topology->triangles);
  return result;
}

/// Back after so many periods of the drive and not before: 1 - cos(2 pi k / n) of the distance is left at k.
void expect_locked(const Strobes& strobes, std::size_t n, double bound) {
  for (std::size_t k = 1; k <= 4; ++k)
    if (k % n == 0)
      EXPECT_LT(strobes.apart[k - 1], bound) << k;
    else
      EXPECT_GT(strobes.apart[k - 1], 1) << k;
}

TEST(BajajZhangXu, Figure5LocksToItsDrive) {
  expect_locked(strobes(":bajaj-5b", 80, 40), 4, 1e-4);
  expect_locked(strobes(":bajaj-5c", 80, 40), 4, 1e-4);
}

/// With delta = 0 the start decides. Spirals of four phases that go on turning carry fronts over every place, so that
/// nothing is locked, with the substrate and without; where their cores have met in pairs all is.
TEST(BajajZhangXu, Figure5WhereVStaysLocksUnlessSpiralsAreLeft) {
  for (const double unevenness : {0.1, 0.0}) {
    const Strobes turning = strobes(":bajaj-5a", 80, 40, {{"unevenness", unevenness}}, 2);
    EXPECT_GT(turning.cores, 1U);
    EXPECT_GT(turning.apart[3], 0.5);
  }
  const Strobes resting = strobes(":bajaj-5a", 80, 40, {{"unevenness", 0}});
  EXPECT_EQ(resting.cores, 0U);
  expect_locked(resting, 4, 1e-4);
}

/// It is no matter of the steps: with half of them the same start does the same.
TEST(BajajZhangXu, Figure5WhereVStaysDoesTheSameWithSmallerSteps) {
  const Strobes coarse = strobes(":bajaj-5a", 24, 40, {}, 2), fine = strobes(":bajaj-5a", 24, 80, {}, 2);
  EXPECT_NEAR(fine.apart[3], coarse.apart[3], 0.02 * coarse.apart[3]);
}

TEST(BajajZhangXu, StrongerDrivesLockAtThreeAndTwo) {
  expect_locked(strobes(":3-to-1", 60, 40), 3, 1e-4);
  expect_locked(strobes(":2-to-1", 60, 160), 2, 1e-4);
}

}  // namespace
}  // namespace pelage
