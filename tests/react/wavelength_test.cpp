#include "react/wavelength.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "catalog/models.h"
#include "react/stability.h"
#include "react/support.h"

namespace pelage {
namespace {

double wavelength_of(const std::string& name, const Overrides& overrides = {}) {
  return model_wavelength(compile(load_model(name), overrides));
}

std::string refusal_of(const Model& model) {
  return error_of([&] { model_wavelength(model); });
}

/// Kinetics without a Turing instability (Gray, Scott 1984) whose diffusions and rates all have a factor, with a
/// measured wavelength.
ModelSource measured_model(const std::string& wavelength = "wavelength = 14") {
  return parse_model("name = 'm'\n" + wavelength + R"toml(
species.u = { diffusion = "2*D", rate = "r*(0.05*(1 - u) - u*v^2)", initial = "1 - start*noise(seed)" }
species.v = { diffusion = "D*ratio", rate = "r*(u*v^2 - 0.113*v*(1 + shift*x))" }
variants.own = { parameters = { D = 9 }, wavelength = 30 }
variants.law = { parameters = { D = 9 }, wavelength = "7*D" }
[parameters]
D = 1
ratio = 1
r = 1
shift = 0
start = 0.1
seed = 2
)toml",
                     "m.toml");
}

double scaled(const Overrides& overrides, const std::string& wavelength = "wavelength = 14") {
  return model_wavelength(compile(measured_model(wavelength), overrides));
}

TEST(Wavelength, FileGoesBeforeTheory) {
  ModelSource source = load_model("schnakenberg");
  source.wavelength.reset();
  EXPECT_NEAR(model_wavelength(compile(source)), 14.9, 0.1);
  source.wavelength = 11.5;
  EXPECT_EQ(model_wavelength(compile(source)), 11.5);
}

TEST(Wavelength, NothingWithoutAFastestWave) {
  const Model model = compile(load_model("turing"), {{"Da", 0.03125}, {"Db", 0.125}});
  EXPECT_NE(refusal_of(model).find("no wavelength of its own"), std::string::npos);
  EXPECT_FALSE(known_wavelength(model));
}

TEST(Wavelength, OtherUnitsOfLengthAndTimeScaleIt) {
  EXPECT_EQ(scaled({}), 14);
  EXPECT_DOUBLE_EQ(scaled({{"D", 4}}), 28);
  EXPECT_DOUBLE_EQ(scaled({{"r", 4}}), 7);
  EXPECT_DOUBLE_EQ(scaled({{"r", 3}, {"D", 27}}), 42);
}

TEST(Wavelength, WhatActsOnTheStartOrOnTheMeanOfThePlaceAloneDoesNotChangeItByABit) {
  EXPECT_EQ(scaled({{"start", 0.3}, {"seed", 5}, {"shift", 0.2}}), 14);
  EXPECT_EQ(wavelength_of("schnakenberg", {{"roughness", 0.3}}), 12.8);
}

/// Run backwards, they are others.
TEST(Wavelength, AFactorBelowZeroIsNoOtherUnit) {
  EXPECT_FALSE(known_wavelength(compile(measured_model(), {{"r", -1}})));
}

TEST(Wavelength, IsRefusedWhereOtherEquationsHaveNoTheory) {
  EXPECT_EQ(
      refusal_of(compile(measured_model(), {{"ratio", 0.5}, {"D", 2}})),
      "m.toml:1:1: the wavelength of model \"m\" is measured at the values of its file; with D = 2, ratio = 0.5 it is "
      "unknown, since linear theory has no wave of that length; choose other values, give --unit instead of --size, or "
      "make "
      "`wavelength` in a file of your own a formula of the parameters");
  EXPECT_NE(refusal_of(compile(load_model("schnakenberg"), {{"d", 5}})).find("no standing wave that grows there"),
            std::string::npos);
  // The fastest wave is that of the layer which is not shown.
  EXPECT_NE(refusal_of(compile(load_model("coupled-brusselators"), {{"Dp", 0.9}})).find("no wave of that length"),
            std::string::npos);
}

TEST(Wavelength, GoesOnInTheRatioOfTheFastestWaves) {
  const auto linear = [](double d) { return *analyse(compile(load_model("schnakenberg"), {{"d", d}})).wavelength; };
  for (const double d : {20.0, 80.0})
    EXPECT_DOUBLE_EQ(wavelength_of("schnakenberg", {{"d", d}}), 12.8 * linear(d) / linear(40)) << d;
}

TEST(Wavelength, AFormulaIsTakenAsItIs) {
  const std::string law = "wavelength = \"2*pi*ratio*sqrt(D/r)\"";
  EXPECT_DOUBLE_EQ(scaled({}, law), 2 * std::acos(-1.0));
  EXPECT_DOUBLE_EQ(scaled({{"ratio", 3}, {"r", 0.25}}, law), 12 * std::acos(-1.0));
}

TEST(Wavelength, AVariantIsTheReferenceOfItsOwnNumber) {
  const std::string law = "wavelength = \"14*D\"";
  const ModelSource own = with_variant(measured_model(law), "own");
  EXPECT_EQ(model_wavelength(compile(own)), 30);
  EXPECT_DOUBLE_EQ(model_wavelength(compile(own, {{"D", 3}})), 10);
  EXPECT_DOUBLE_EQ(model_wavelength(compile(compile(own, {{"D", 27}}).source(), {{"D", 3}})), 10);
  EXPECT_DOUBLE_EQ(model_wavelength(compile(with_variant(measured_model(law), "law"), {{"D", 3}})), 21);
  EXPECT_DOUBLE_EQ(model_wavelength(compile(with_variant(measured_model(), "own"), {{"D", 36}})), 60);
}

TEST(Wavelength, FaultsOfTheFormulaAreLocated) {
  EXPECT_EQ(error_of([] { compile(measured_model("wavelength = \"14*ratoi\"")); }),
            "m.toml:2:18: unknown name \"ratoi\"; did you mean \"ratio\"?");
  for (const char* text : {"14*u", "14*t", "lap(u)"})
    EXPECT_NE(
        error_of([&] { compile(measured_model("wavelength = \"" + std::string(text) + "\"")); }).find("m.toml:2:15: "),
        std::string::npos);
  EXPECT_EQ(error_of([] { scaled({}, "wavelength = \"14*x\""); }),
            "m.toml:2:15: a wavelength must be a number or made of parameters");
  EXPECT_EQ(error_of([] {
              scaled({{"D", 0}}, "wavelength = \"1/D\"");
            }),
            "m.toml:2:15: model \"m\" has no pattern of a certain wavelength with these parameters (its formula gives "
            "inf); choose others");
  EXPECT_NE(error_of([] { scaled({}, "wavelength = 0"); }).find("greater than 0"), std::string::npos);
}

/// Of every built-in model whose diffusions all have a parameter: a unit of length four times as large must make
/// everything four times as large.
TEST(Wavelength, OfEveryModelHasTheUnitOfALength) {
  constexpr double factor = 4;
  int models = 0;
  for (const ModelEntry& entry : model_list()) {
    Overrides overrides;
    for (const ParameterSource& p : entry.source.parameters) {
      if (p.unit == "length") overrides[p.name] = factor * p.value;
      if (p.unit.starts_with("length^2")) overrides[p.name] = factor * factor * p.value;
    }
    ModelSource source = entry.source;
    for (ParameterSource& p : source.parameters) p.max = std::numeric_limits<double>::infinity();
    const Model plain = compile(source), larger = compile(source, overrides);
    bool all = true;
    for (std::size_t i = 0; i < plain.species_count(); ++i) {
      const auto before = plain.diffusion_constant(i), now = larger.diffusion_constant(i);
      all = all && before && now && std::abs(*now - factor * factor * *before) <= 1e-12 * *now &&
            plain.equations().cross == larger.equations().cross;
    }
    if (!all || overrides.empty()) continue;
    ++models;
    EXPECT_NEAR(model_wavelength(larger) / model_wavelength(plain), factor, 1e-6) << entry.name;
  }
  EXPECT_GT(models, 40);
}

/// What the files said before their wavelengths followed the parameters.
TEST(Wavelength, OfEveryModelAtItsOwnValuesIsTheMeasuredOne) {
  const std::map<std::string, double> measured = {{"baer-eiswirth", 7.3},
                                                  {"baer-eiswirth:turbulence", 9.6},
                                                  {"barkley", 7.7},
                                                  {"cahn-hilliard", 13.4},
                                                  {"cahn-hilliard:droplets", 13.1},
                                                  {"combed-stripes", 7.9},
                                                  {"complex-ginzburg-landau", 17},
                                                  {"complex-ginzburg-landau:turbulent", 15},
                                                  {"coupled-brusselators", 8.8},
                                                  {"coupled-brusselators:white-eyes", 27},
                                                  {"coupled-brusselators:black-eyes", 20},
                                                  {"fitzhugh-nagumo:labyrinth", 6.3},
                                                  {"fitzhugh-nagumo:bajaj-4a", 6.7},
                                                  {"fitzhugh-nagumo:bajaj-4b", 6.1},
                                                  {"fitzhugh-nagumo:bajaj-4c", 5.9},
                                                  {"fitzhugh", 15},
                                                  {"forced-brusselator", 68},
                                                  {"forced-brusselator:3-to-1", 88},
                                                  {"forced-brusselator:2-to-1", 78},
                                                  {"forced-brusselator:literal", 82},
                                                  {"forced-brusselator:bajaj-5a", 30},
                                                  {"forced-brusselator:bajaj-5b", 49},
                                                  {"forced-brusselator:bajaj-5c", 14},
                                                  {"gray-scott", 13.9},
                                                  {"gray-scott:spots", 14.5},
                                                  {"gray-scott:holes", 14.7},
                                                  {"gray-scott:coral", 14},
                                                  {"gray-scott:fingerprints", 13.9},
                                                  {"gray-scott:pulsating", 13.6},
                                                  {"gray-scott:gamma", 14},
                                                  {"gray-scott:delta", 15.2},
                                                  {"gray-scott:epsilon", 19.5},
                                                  {"gray-scott:zeta", 14},
                                                  {"gray-scott:eta", 13},
                                                  {"gray-scott:theta", 14.2},
                                                  {"gray-scott:iota", 13.8},
                                                  {"gray-scott:lambda", 14},
                                                  {"gray-scott:mu", 13.7},
                                                  {"gray-scott:nu", 19.3},
                                                  {"gray-scott:pi", 15.2},
                                                  {"keller-segel", 7.7},
                                                  {"keller-segel:droplets", 7.9},
                                                  {"klausmeier", 16.1},
                                                  {"kpz", 9.4},
                                                  {"kuramoto-sivashinsky", 13.1},
                                                  {"kuramoto-sivashinsky:cells", 13.1 - 15 * 0.2},
                                                  {"lambda-omega", 20},
                                                  {"meinhardt-stripes", 15.4},
                                                  {"mimura-murray", 0.92},
                                                  {"ohta-kawasaki", 11},
                                                  {"ohta-kawasaki:dots", 11},
                                                  {"oregonator", 32},
                                                  {"polar-order", 32},
                                                  {"schenk-purwins", 0.23},
                                                  {"schnakenberg", 12.8},
                                                  {"stretched-spots", 7},
                                                  {"witkin-kass-2", 8.2},
                                                  {"witkin-kass-2:maze", 10.9},
                                                  {"witkin-kass-2:paper", 8.2},
                                                  {"witkin-kass-3", 8.7},
                                                  {"witkin-kass-3:paper", 8.7},
                                                  {"witkin-kass-5", 8.5},
                                                  {"witkin-kass-5:paper", 8.5},
                                                  {"witkin-kass-5:twisty-maze", 10.5},
                                                  {"witkin-kass-stripes", 7.9},
                                                  {"witkin-kass-stripes:paper", 7.9},
                                                  {"witkin-kass", 10.7},
                                                  {"witkin-kass:worms", 10.7},
                                                  {"witkin-kass:giraffe", 10}};
  for (const ModelEntry& entry : model_list()) {
    const auto number = measured.find(entry.name);
    EXPECT_EQ(states_wavelength(entry.source), number != measured.end()) << entry.name;
    if (number == measured.end()) continue;
    EXPECT_EQ(model_wavelength(compile(entry.source)), number->second) << entry.name;
  }
}

}  // namespace
}  // namespace pelage
