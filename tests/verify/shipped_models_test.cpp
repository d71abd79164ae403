// What every shipped model and variant must do in a run, without a line of its own. docs/models.md says how it is
// measured.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <optional>

#include "base/box.h"
#include "catalog/bind.h"
#include "catalog/models.h"
#include "react/stability.h"
#include "react/wavelength.h"
#include "shape/generators.h"
#include "support/model_names.h"
#include "verify/early_growth.h"
#include "verify/finished_pattern.h"

namespace pelage {
namespace {

/// Of FinishedPattern::contrast. Uniform states stay below 1e-4; the faintest pattern that is shipped, white eyes in
/// the weaker layer of coupled Brusselators, has 1e-2.
constexpr double least_contrast = 5e-3;

Program program(const std::string& model, const TriangleMesh& shape, double size,
                std::optional<std::int64_t> steps = {}, std::uint64_t seed = 1) {
  Recipe recipe;
  recipe.stages[0].seed = seed;
  // A moment of turbulence is no mean: the file has what was measured with this method.
  if (model.ends_with(":turbulent")) recipe.stages[0].method.value = "loop";
  recipe.stages[0].model.value = model;
  recipe.stages[0].size = Given<Length>{{size, Length::Unit::world}, {}};
  recipe.stages[0].steps = steps;
  recipe.stages[0].interpolate = true;
  return make_program(recipe, shape);
}

void expect_pattern(const FinishedPattern& pattern) {
  EXPECT_NE(pattern.status, RunStatus::failed) << pattern.message;
  EXPECT_GE(pattern.contrast, least_contrast);
}

/// The few spirals of Baer and Eiswirth that a small sphere holds must not be such that they annihilate each other,
/// which fine meshes of either method show of start 1; of the spots that pulsate some die by chance; and of few waves
/// the size depends on the start: of eight starts turbulence is at rest once, and the oregonator's are 27 to 40.
std::uint64_t start(const std::string& model) {
  if (model == "gray-scott:pulsating" || model == "oregonator") return 2;
  if (model == "baer-eiswirth:turbulence") return 3;
  return model == "baer-eiswirth" ? 5 : 1;
}

class GrownModel : public testing::TestWithParam<std::string> {};

TEST_P(GrownModel, PatternOfItsWavelengthOnASphere) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=642");
  // Coupled layers have a wavelength each; their file gives that of the layer that is shown.
  const bool coupled = GetParam().starts_with("coupled-");
  const FinishedPattern pattern = finish_pattern(program(GetParam(), sphere, 0.9, {}, start(GetParam())));
  expect_pattern(pattern);
  const double reference = model_wavelength(compile(load_model(GetParam())));
  EXPECT_NEAR(coupled ? pattern.shown_wavelength : pattern.wavelength, reference, 0.15 * reference);
}

/// A model is run to its end. Its variants, which are finished on the sphere, have the same equations with other
/// numbers: here they show that their start and their step suit an irregular mesh, too, where too large a step fails at
/// once.
TEST_P(GrownModel, PatternOnTheAnimal) {
  static const TriangleMesh animal = builtin_shape("builtin:animal?n=1000");
  constexpr std::int64_t first_steps = 50;
  const bool variant = GetParam().find(':') != std::string::npos;
  const double size = 0.15 * box_of(animal.points).diagonal();
  if (!variant) return expect_pattern(finish_pattern(program(GetParam(), animal, size)));
  const FinishedPattern begun = finish_pattern(program(GetParam(), animal, size, first_steps));
  EXPECT_NE(begun.status, RunStatus::failed) << begun.message;
  EXPECT_TRUE(std::isfinite(begun.contrast));
}

TEST_P(GrownModel, FastestWaveOfTheEarlyGrowth) {
  const ModelSource source = load_model(GetParam());
  Overrides even;
  for (const ParameterSource& p : source.parameters)
    if (p.name == "unevenness") even[p.name] = 0;
  const Model model = compile(source, even);
  for (const NodeId rate : model.equations().rate)
    if (model.equations().graph[rate].dependence & (on_place | on_time))
      GTEST_SKIP() << "the rates vary in space or time";
  for (std::size_t i = 0; i < model.species_count(); ++i)
    if (model.anisotropic(i) || model.has_tensor(i)) GTEST_SKIP() << "the growth differs with the direction";
  const Stability stability = analyse(model);
  if (!stability.band_max || stability.oscillatory) GTEST_SKIP() << "no uniform state that is Turing-unstable";
  const EarlyGrowth growth = measure_early_growth(GetParam(), 1002, 9);
  EXPECT_NEAR(growth.wavelength, *stability.wavelength, 0.05 * *stability.wavelength);
}

INSTANTIATE_TEST_SUITE_P(All, GrownModel, testing::ValuesIn(all_model_names()), model_test_name);

/// A system that is not shipped: Degn and Harrison 1969 (respiration of bacteria), written as CONTRIBUTING says.
constexpr const char* degn_harrison = R"toml(
name = "degn-harrison"
title = "Degn-Harrison"
cite = "Degn, Harrison 1969, J. Theor. Biol. 22, 238-248"
summary = "Oxygen u and nutrient v of a bacterial culture."

[species.v]
diffusion = "d"
rate = "a - h"
initial = "a*(1 + k*(b - a)^2)/(b - a)"
min = 0

[species.u]
diffusion = 1
rate = "b - u - h"
initial = "(b - a)*(1 + 0.01*noise(3))"
min = 0

[definitions]
h = "u*v/(1 + k*u^2)"

[parameters]
a = { value = 10, min = 0, max = 20, unit = "1", help = "supply of v" }
b = { value = 16, min = 0, max = 20, unit = "1", help = "supply of u" }
k = { value = 0.3, min = 0, max = 10, unit = "1", help = "inhibition by u" }
d = { value = 40, min = 0, max = 1000, unit = "1", help = "diffusion of v over that of u" }

[suggested]
step = 0.05
end = 100
tolerance = 1e-3
)toml";

TEST(AddedModel, IsAnalysedAndGrownFromItsFile) {
  const std::string path = testing::TempDir() + "pelage_added_model.toml";
  std::ofstream(path) << degn_harrison;
  const Stability stability = analyse(compile(load_model(path)));
  ASSERT_TRUE(stability.wavelength);
  EXPECT_GT(stability.growth, 0);
  EXPECT_NEAR(measure_early_growth(path, 1002, 9).wavelength, *stability.wavelength, 0.05 * *stability.wavelength);
  expect_pattern(finish_pattern(program(path, builtin_shape("builtin:sphere?n=642"), 0.9)));
  std::remove(path.c_str());
}

}  // namespace
}  // namespace pelage
