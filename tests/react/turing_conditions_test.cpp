#include "react/turing_conditions.h"

#include <cmath>

#include "catalog/models.h"
#include "react/stability.h"
#include "react/support.h"

namespace pelage {
namespace {

Stability analysis_of(const std::string& name, const Overrides& overrides = {}) {
  return analyse(compile(load_model(name), overrides));
}

/// Of two species the one that makes more of itself; the other inhibits or feeds it.
std::size_t activator(const Stability& s) { return s.jacobian[0] > 0 ? 0 : 1; }

/// Inhibitor over activator at the threshold, in closed form: with u the activator and x = sqrt(D_v / D_u) the
/// condition D_v f_u + D_u g_v = 2 sqrt(D_u D_v det J) reads f_u x^2 - 2 sqrt(det J) x + g_v = 0.
double critical_ratio(const Stability& s) {
  const std::vector<double>& J = s.jacobian;
  const double fu = J[3 * activator(s)], gv = J[3 - 3 * activator(s)], determinant = J[0] * J[3] - J[1] * J[2];
  const double x = (std::sqrt(determinant) + std::sqrt(determinant - fu * gv)) / fu;
  return x * x;
}

/// The threshold of one diffusion; the two of a pair come in the order of the species.
DiffusionThreshold threshold_of(const Stability& s, std::size_t species) {
  const auto thresholds = diffusion_thresholds(s);
  EXPECT_EQ(thresholds.size(), 2u);
  EXPECT_EQ(thresholds[species].species, species);
  return thresholds[species];
}

std::vector<std::string> numbered_names(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back("u" + std::to_string(i));
  return names;
}

TEST(TuringConditions, ThresholdsAreThoseOfTheClosedForm) {
  for (const double d : {3.0, 12.0, 40.0, 200.0}) {  // on both sides of the threshold
    const Stability s = analysis_of("schnakenberg", {{"a", 0.1}, {"b", 0.9}, {"d", d}});
    const double ratio = critical_ratio(s);
    EXPECT_NEAR(ratio, 8.5676, 1e-4);
    const auto slow = threshold_of(s, activator(s)), fast = threshold_of(s, 1 - activator(s));
    EXPECT_FALSE(slow.grows_above);
    EXPECT_TRUE(fast.grows_above);
    EXPECT_NEAR(slow.diffusion, d / ratio, 1e-6 * d / ratio);
    EXPECT_NEAR(fast.diffusion, ratio, 1e-6 * ratio);
  }
}

TEST(TuringConditions, BrusselatorThresholdOfTheLiterature) {  // Dv = Du A^2 / (sqrt(B) - 1)^2
  for (const double B : {2.0, 3.0, 4.5}) {
    const Stability s = analysis_of("brusselator", {{"A", 2}, {"B", B}, {"Du", 1}, {"Dv", 8}});
    const double expected = 4 / std::pow(std::sqrt(B) - 1, 2);
    EXPECT_NEAR(threshold_of(s, 1 - activator(s)).diffusion, expected, 1e-6 * expected);
  }
}

TEST(TuringConditions, AllFourHoldExactlyWhenAPatternGrows) {
  for (const double d : {2.0, 5.0, 8.0, 8.5, 8.9, 9.3, 12.0, 40.0}) {
    const Stability s = analysis_of("schnakenberg", {{"a", 0.1}, {"b", 0.9}, {"d", d}});
    bool all = true;
    for (const Condition& c : turing_conditions(s, {"p", "q"})) all = all && c.holds;
    EXPECT_EQ(all, regime_of(s) == Regime::turing) << d;
    EXPECT_EQ(regime_of(s) == Regime::turing, d > critical_ratio(s)) << d;
  }
}

TEST(TuringConditions, MarginalModelSitsOnItsThreshold) {
  const Model model = compile(load_model("turing"));
  const Stability s = analyse(model);
  EXPECT_EQ(regime_of(s), Regime::marginal);
  std::vector<std::string> names = {model.species_name(0), model.species_name(1)};
  EXPECT_NEAR(threshold_of(s, names[0] == "a" ? 0 : 1).diffusion, 0.125, 1e-6);
  EXPECT_FALSE(turing_conditions(s, names).back().holds);
  const auto words = describe(diffusion_thresholds(s), s, names);
  ASSERT_EQ(words.size(), 1u);
  EXPECT_EQ(words[0], "no pattern: D_a / D_b must be above 4, here it is 4");
}

TEST(TuringConditions, Regimes) {
  EXPECT_EQ(regime_of(analysis_of("turing:production")), Regime::turing);
  EXPECT_EQ(regime_of(analysis_of("gray-scott")), Regime::quiet);
  EXPECT_EQ(regime_of(analysis_of("brusselator", {{"A", 2}, {"B", 6}, {"Du", 1}, {"Dv", 1}})), Regime::oscillation);
  EXPECT_EQ(regime_of(analysis_of("schnakenberg", {{"a", 0.05}, {"b", 0.5}, {"d", 8}})), Regime::mixed);
  EXPECT_EQ(regime_of(analysis_of("turing", {{"Db", 0}})), Regime::ever_shorter);
}

/// Three species, the third fed by the second and read by nobody: the threshold is that of two.
TEST(TuringConditions, ThirdSpeciesThatOnlyFollows) {
  Stability two;
  two.jacobian = {0.8, 1, -1.8, -1};
  Stability three;
  three.steady_states = {{1, 0.9, 0.45}};
  three.jacobian = {0.8, 1, 0, -1.8, -1, 0, 0, 1, -2};
  three.diffusion = {1, 5, 3};
  three.eigenvalues = {{-0.1, std::sqrt(0.99)}, {-0.1, -std::sqrt(0.99)}, -2};
  const auto thresholds = diffusion_thresholds(three);
  ASSERT_EQ(thresholds.size(), 2u);  // the follower's own diffusion changes nothing
  EXPECT_NEAR(thresholds[1].diffusion, critical_ratio(two), 1e-6 * critical_ratio(two));
  EXPECT_EQ(describe(thresholds, three, numbered_names(3)).size(), 2u);
  EXPECT_FALSE(turing_conditions(three, numbered_names(3)).back().holds);
}

/// With a flux of v along -grad u, c = 2.5, det(J - k^2 D) = D k^4 + (2 - D - c) k^2 + 1 is nowhere negative for D_v =
/// D between (1 - r)^2 and (1 + r)^2, r = sqrt(3 - c): there are two thresholds, of which the nearer one is told.
TEST(TuringConditions, OfTwoThresholdsTheNearerOneIsTold) {
  Stability s;
  s.steady_states = {{0, 0}};
  s.jacobian = {1, -1, 3, -2};
  s.fluxes = {0, 0, 2.5, 0};
  s.eigenvalues = {{-0.5, std::sqrt(0.75)}, {-0.5, -std::sqrt(0.75)}};
  const double root = std::sqrt(0.5), low = std::pow(1 - root, 2), high = std::pow(1 + root, 2);
  for (const double d : {0.2, 1.0}) {  // low is 2.3 times less than the first, high 2.9 times more than the second
    s.diffusion = {1, d};
    const DiffusionThreshold t = threshold_of(s, 1);
    EXPECT_EQ(t.grows_above, d == 1);
    EXPECT_NEAR(t.diffusion, d == 1 ? high : low, 1e-6);
  }
}

/// Swift-Hohenberg as w = lap(u), du/dt = r u - u - 2 w - lap(w): sigma = r - (1 - k^2)^2, so that r = 0 is marginal.
TEST(TuringConditions, CrossDiffusionAndAlgebraicSpecies) {
  for (const double r : {-0.1, 0.2}) {
    const Stability s = analysis_of("swift-hohenberg", {{"r", r}});
    EXPECT_EQ(regime_of(s), r > 0 ? Regime::turing : Regime::quiet);
    const auto conditions = turing_conditions(s, {"w", "u"});
    ASSERT_EQ(conditions.size(), 2u);  // the classical four are not about such pairs
    EXPECT_EQ(conditions[1].holds, r > 0);
  }
}

TEST(TuringConditions, NothingToSayWithoutAState) {
  EXPECT_EQ(regime_of({}), Regime::no_state);
  EXPECT_TRUE(turing_conditions({}, {"u", "v"}).empty());
  EXPECT_TRUE(diffusion_thresholds({}).empty());
}

TEST(Stability, EveryStateHasItsOwnAnalysis) {
  const Model model = compile(load_model("gray-scott"), {{"F", 0.04}, {"k", 0.055}});
  const Stability all = analyse(model);
  ASSERT_EQ(all.steady_states.size(), 3u);
  for (const auto& state : all.steady_states) {
    const Stability one = analyse_at(model, state);
    const std::size_t first = model.species_name(0) == "u" ? 0 : 1;
    const double u = state[first], v = state[1 - first], F = 0.04, k = 0.055;
    EXPECT_NEAR(one.jacobian[3 * first], -v * v - F, 1e-12);
    EXPECT_NEAR(one.jacobian[3 - 3 * first], 2 * u * v - F - k, 1e-12);
    EXPECT_NEAR(one.jacobian[1 + first], -2 * u * v, 1e-12);  // dR_u / dv
    ASSERT_EQ(one.steady_states.size(), 1u);
    EXPECT_EQ(one.steady_states[0], state);
  }
}

}  // namespace
}  // namespace pelage
