#include "react/turing_conditions.h"

#include <cmath>

#include "catalog/models.h"
#include "react/support.h"

namespace pelage {
namespace {

Stability analysis_of(const std::string& name, const Overrides& overrides = {}) {
  return analyse(compile(load_model(name), overrides));
}

/// The closed form for two species, u the one with J_uu > 0: with x = sqrt(D_v / D_u) the condition
/// D_v f_u + D_u g_v = 2 sqrt(D_u D_v det J) reads f_u x^2 - 2 sqrt(det J) x + g_v = 0.
double critical_ratio(double fu, double fv, double gu, double gv) {
  const double determinant = fu * gv - fv * gu;
  const double x = (std::sqrt(determinant) + std::sqrt(determinant - fu * gv)) / fu;
  return x * x;
}

std::vector<std::string> numbered_names(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back("u" + std::to_string(i));
  return names;
}

TEST(TuringConditions, ThresholdsAreThoseOfTheClosedForm) {
  for (const double d : {3.0, 12.0, 40.0, 200.0}) {  // on both sides of the threshold
    const Stability s = analysis_of("schnakenberg", {{"d", d}});
    const double ratio = critical_ratio(s.jacobian[3], s.jacobian[2], s.jacobian[1], s.jacobian[0]);  // v is first
    const auto thresholds = diffusion_thresholds(s);
    ASSERT_EQ(thresholds.size(), 2u);
    EXPECT_TRUE(thresholds[0].grows_above);
    EXPECT_FALSE(thresholds[1].grows_above);  // the activator must diffuse slowly
    EXPECT_NEAR(thresholds[0].diffusion, ratio, 1e-6 * ratio);
    EXPECT_NEAR(thresholds[1].diffusion, d / ratio, 1e-6 * d / ratio);
  }
}

TEST(TuringConditions, BrusselatorThresholdOfTheLiterature) {  // Dv = Du A^2 / (sqrt(B) - 1)^2
  for (const double B : {2.0, 3.0, 4.5}) {
    const auto thresholds = diffusion_thresholds(analysis_of("brusselator", {{"B", B}}));
    ASSERT_EQ(thresholds.size(), 2u);
    const double expected = 4 / std::pow(std::sqrt(B) - 1, 2);
    EXPECT_NEAR(thresholds[0].diffusion, expected, 1e-6 * expected);
  }
}

TEST(TuringConditions, AllFourHoldExactlyWhenAPatternGrows) {
  for (const double d : {2.0, 5.0, 8.0, 8.5, 8.9, 9.3, 12.0, 40.0}) {
    const Stability s = analysis_of("schnakenberg", {{"d", d}});
    bool all = true;
    for (const Condition& c : turing_conditions(s, {"u", "v"})) all = all && c.holds;
    EXPECT_EQ(all, regime_of(s) == Regime::turing) << d;
    EXPECT_EQ(regime_of(s) == Regime::turing, d > diffusion_thresholds(s)[0].diffusion) << d;
  }
}

TEST(TuringConditions, MarginalModelSitsOnItsThreshold) {
  const Stability s = analysis_of("turing");
  EXPECT_EQ(regime_of(s), Regime::marginal);
  const auto thresholds = diffusion_thresholds(s);
  ASSERT_EQ(thresholds.size(), 2u);
  EXPECT_NEAR(thresholds[0].diffusion, 0.125, 1e-6);
  EXPECT_FALSE(turing_conditions(s, {"a", "b"}).back().holds);
  const auto words = describe(thresholds, s, {"a", "b"});
  ASSERT_EQ(words.size(), 1u);
  EXPECT_EQ(words[0], "no pattern: D_a / D_b must be above 4, here it is 4");
}

TEST(TuringConditions, Regimes) {
  EXPECT_EQ(regime_of(analysis_of("turing:production")), Regime::turing);
  EXPECT_EQ(regime_of(analysis_of("gray-scott")), Regime::quiet);
  EXPECT_EQ(regime_of(analysis_of("brusselator", {{"B", 6}, {"Dv", 1}})), Regime::oscillation);
  EXPECT_EQ(regime_of(analysis_of("schnakenberg", {{"a", 0.05}, {"b", 0.5}, {"d", 8}})), Regime::mixed);
  EXPECT_EQ(regime_of(analysis_of("turing", {{"Db", 0}})), Regime::ever_shorter);
}

/// Three species, the third a copy of the second that nobody reads: the threshold is that of two.
TEST(TuringConditions, ThirdSpeciesThatOnlyFollows) {
  Stability three = analysis_of("schnakenberg", {{"d", 5}});
  const std::vector<double> J = three.jacobian;
  three.jacobian = {J[0], J[1], 0, J[2], J[3], 0, 0, 1, -2};
  three.diffusion = {5, 1, 3};
  three.eigenvalues = {three.eigenvalues[0], three.eigenvalues[1], -2};
  const auto thresholds = diffusion_thresholds(three);
  ASSERT_EQ(thresholds.size(), 2u);  // the follower's own diffusion changes nothing
  const double ratio = critical_ratio(J[3], J[2], J[1], J[0]);
  EXPECT_NEAR(thresholds[0].diffusion, ratio, 1e-6 * ratio);
  EXPECT_EQ(describe(thresholds, three, numbered_names(3)).size(), 2u);
  EXPECT_FALSE(turing_conditions(three, numbered_names(3)).back().holds);
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
    const double u = state[0], v = state[1], F = 0.04, k = 0.055;
    const double expected[] = {-v * v - F, -2 * u * v, v * v, 2 * u * v - F - k};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(one.jacobian[i], expected[i], 1e-12);
    ASSERT_EQ(one.steady_states.size(), 1u);
    EXPECT_EQ(one.steady_states[0], state);
  }
}

}  // namespace
}  // namespace pelage
