#include <pelage/analyse.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "api_support.h"

namespace pelage::api {
namespace {

/// docs/models.md: at Da = 4 Db the fastest wave is 2 pi sqrt(Db / s) long and neither grows nor decays.
TEST(Analyse, TheThresholdOfTuringsModel) {
  const ModelAnalyser turing("turing");
  for (const auto& [diffusion, speed] : {std::pair{0.03125, 0.05}, {0.03125, 0.2}, {0.5, 0.05}}) {
    const Analysis a = turing.at({{"Db", diffusion}, {"Da", 4 * diffusion}, {"s", speed}});
    ASSERT_TRUE(a.stability.wavelength);
    EXPECT_NEAR(*a.stability.wavelength / (2 * std::numbers::pi * std::sqrt(diffusion / speed)), 1, 1e-4);
    EXPECT_EQ(a.regime, Regime::marginal);
    EXPECT_EQ(a.parameters.at("s"), speed);
    EXPECT_FALSE(a.stability.oscillatory);
  }
}

TEST(Analyse, StatesAndGrowthOfTuringsModel) {
  const Analysis a = analyse("turing", {{"Da", 0.15}});
  EXPECT_EQ(a.species, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(a.states.size(), a.stability.steady_states.size());
  for (const double value : a.stability.steady_states[a.stability.chosen]) EXPECT_NEAR(value, 4, 1e-6);
  EXPECT_EQ(a.regime, Regime::turing);
  EXPECT_EQ(a.verdict, describe(Regime::turing));
  EXPECT_GT(a.stability.growth, 0);
  const double k = 2 * std::numbers::pi / *a.stability.wavelength;
  EXPECT_NEAR(growth_rate(a.stability, k).real(), a.stability.growth, 1e-9);
  EXPECT_LT(*a.stability.band_min, k);
  EXPECT_GT(*a.stability.band_max, k);
  EXPECT_NEAR(growth_rate(a.stability, *a.stability.band_min).real(), 0, 1e-6);
  ASSERT_EQ(a.conditions.size(), 4u);
  for (const Condition& c : a.conditions) EXPECT_TRUE(c.holds) << c.text;
  ASSERT_EQ(a.thresholds.size(), 2u);
  EXPECT_NEAR(a.thresholds[0].diffusion, 4 * 0.03125, 1e-5);
  EXPECT_TRUE(a.thresholds[0].grows_above);
  ASSERT_EQ(a.thresholds_in_words.size(), 1u);
  EXPECT_NE(a.thresholds_in_words[0].find("D_a / D_b"), std::string::npos) << a.thresholds_in_words[0];
  EXPECT_LT(std::abs(*a.spacing / *a.stability.wavelength - 1), 0.5);
}

/// Semi-implicit Euler takes steps of at most 1 / (28 s) for Turing's model, whatever the mesh: the roots of its
/// characteristic polynomial at k = 0.
TEST(Analyse, LargestStepsOfTuringsModel) {
  for (const double s : {0.05, 0.1}) {
    const Analysis a = analyse("turing", {{"s", s}});
    bool found = false;
    for (const StepLimit& limit : a.largest_steps) {
      EXPECT_GT(limit.step, 0);
      if (limit.stepper != "semi-implicit") continue;
      found = true;
      EXPECT_NEAR(28 * s * limit.step, 1, 1e-3);
    }
    EXPECT_TRUE(found);
  }
}

TEST(Analyse, AModelAsTextIsTheModel) {
  const ModelTexts texts = {{"mine", {bytes_of(PELAGE_SOURCE_DIR "/models/turing.toml")}}};
  const Analysis mine = analyse("mine:production", {{"s", 0.07}}, texts);
  const Analysis built_in = analyse("turing:production", {{"s", 0.07}});
  EXPECT_EQ(mine.stability.wavelength, built_in.stability.wavelength);
  EXPECT_EQ(mine.stability.growth, built_in.stability.growth);
  EXPECT_EQ(mine.parameters, built_in.parameters);
  EXPECT_EQ(mine.spacing, built_in.spacing);
}

TEST(Analyse, FaultsAreRefused) {
  EXPECT_EQ(fault_of([] { analyse("no such model"); }), 2);
  EXPECT_EQ(fault_of([] { analyse("turing", {{"no_such", 1}}); }), 2);
  EXPECT_EQ(fault_of([] { analyse("turing", {{"Da", -1}}); }), 2);
  EXPECT_EQ(fault_of([] { analyse("no/such/file.toml"); }), 3);
  EXPECT_EQ(fault_of([] { analyse("mine", {}, {{"mine", "name = "}}); }), 2);
}

TEST(Analyse, BuiltInModelsAreNamed) {
  const std::vector<std::string> names = model_names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "turing"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "turing:production"), 1);
}

}  // namespace
}  // namespace pelage::api
