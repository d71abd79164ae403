#include "catalog/models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/random.h"
#include "catalog/embedded.h"
#include "react/kinetics.h"
#include "react/stability.h"
#include "support/model_names.h"

namespace pelage {
namespace {

std::string error_of(const std::string& name, Fault fault = Fault::usage) {
  try {
    load_model(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

/// Checks that every model and variant passes without a line of its own.
class ShippedModel : public testing::TestWithParam<std::string> {
 protected:
  static constexpr std::size_t samples = 500;
  ShippedModel() : model_(compile(load_model(GetParam()))), n_(model_.species_count()), points_(samples) {
    for (std::size_t i = 0; i < samples; ++i)
      for (std::size_t d = 0; d < 3; ++d) points_[i][d] = 30 * uniform(1, 3 * i + d);
    for (std::size_t s = 0; s < n_; ++s)
      for (std::size_t i = 0; i < samples; ++i) u_.push_back(0.05 + 3 * uniform(2 + s, i));
  }
  Places places() const { return {.positions = points_, .normals = points_, .k1 = zero_, .k2 = zero_}; }
  Kinetics kinetics() const { return Kinetics(model_, places(), 1); }
  static std::vector<const double*> rows(const std::vector<double>& values) {
    std::vector<const double*> result;
    for (std::size_t k = 0; k < values.size() / samples; ++k) result.push_back(values.data() + k * samples);
    return result;
  }
  /// Of the species, and behind them products of gradients.
  std::vector<const double*> inputs(const std::vector<double>& u) const {
    std::vector<const double*> result = rows(u);
    result.resize(n_ + model_.equations().gradients.size(), gradients_.data());
    return result;
  }
  static std::vector<double*> rows(std::vector<double>& values) {
    std::vector<double*> result;
    for (std::size_t k = 0; k < values.size() / samples; ++k) result.push_back(values.data() + k * samples);
    return result;
  }
  std::vector<double> rates(const Kinetics& kinetics, const std::vector<double>& u) const {
    std::vector<double> result(n_ * samples);
    kinetics.rates(inputs(u), 0.3, 0, samples, rows(result));
    return result;
  }

  Model model_;
  std::size_t n_;
  std::vector<Point> points_;
  std::vector<double> zero_ = std::vector<double>(samples, 0.0), gradients_ = std::vector<double>(samples, 0.7), u_;
};

TEST_P(ShippedModel, IsDescribed) {
  const ModelSource& source = model_.source();
  EXPECT_FALSE(source.title.empty() || source.cite.empty() || source.summary.empty());
  for (const ParameterSource& p : source.parameters) {
    EXPECT_FALSE(p.unit.empty() || p.help.empty()) << p.name;
    EXPECT_TRUE(std::isfinite(p.min) && std::isfinite(p.max)) << p.name;
  }
  EXPECT_TRUE(source.suggestions.step && source.suggestions.end && source.suggestions.tolerance);
}

TEST_P(ShippedModel, SplitRestoresTheRate) {
  const Kinetics k = kinetics();
  const std::vector<double> rate = rates(k, u_);
  std::vector<double> c2(n_ * samples), c3(n_ * samples);
  k.split(inputs(u_), 0.3, 0, samples, rows(c2), rows(c3));
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const double scale = std::fabs(c2[i] * u_[i]) + std::fabs(c3[i]);
    ASSERT_NEAR(c2[i] * u_[i] + c3[i], rate[i], 1e-12 * (1 + scale));
  }
}

TEST_P(ShippedModel, JacobianAgreesWithDifferences) {
  const Kinetics k = kinetics();
  std::vector<double> jacobian(n_ * n_ * samples);
  k.jacobian(inputs(u_), 0.3, 0, samples, rows(jacobian));
  for (std::size_t j = 0; j < n_; ++j) {
    const double h = 1e-5;
    std::vector<double> more = u_, less = u_;
    for (std::size_t i = 0; i < samples; ++i) more[j * samples + i] += h, less[j * samples + i] -= h;
    const std::vector<double> above = rates(k, more), below = rates(k, less);
    for (std::size_t s = 0; s < n_; ++s)
      for (std::size_t i = 0; i < samples; ++i) {
        const double difference = (above[s * samples + i] - below[s * samples + i]) / (2 * h);
        ASSERT_NEAR(jacobian[(s * n_ + j) * samples + i], difference, 1e-6 * (1 + std::fabs(difference)));
      }
  }
}

TEST_P(ShippedModel, InitialValuesAreWithinBounds) {
  for (std::size_t s = 0; s < n_; ++s)
    for (const double value : initial_values(model_, s, places(), 1))
      ASSERT_TRUE(value >= model_.lower(s) && value <= model_.upper(s));
}

TEST_P(ShippedModel, ParametersRoundTrip) {
  for (const ParameterSource& p : model_.parameters()) {
    const double value = p.value > 0 && 1.01 * p.value <= p.max ? 1.01 * p.value : p.value;
    const Model changed = compile(model_.source(), {{p.name, value}});
    for (const ParameterSource& q : changed.parameters()) EXPECT_TRUE(q.name != p.name || q.value == value) << q.name;
    EXPECT_THROW(compile(model_.source(), {{p.name, p.max + 1}}), Error);
    EXPECT_THROW(compile(model_.source(), {{p.name, p.min - 1}}), Error);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedModel, testing::ValuesIn(all_model_names()), model_test_name);

TEST(Models, NamesAreThoseOfTheFiles) {
  std::set<std::string> names;
  for (const ModelEntry& entry : model_list()) {
    EXPECT_TRUE(names.insert(entry.name).second);
    const std::string model = entry.name.substr(0, entry.name.find(':'));
    EXPECT_TRUE(std::ifstream(std::string(PELAGE_SOURCE_DIR) + "/models/" + model + ".toml")) << model;
  }
  for (const char* name : {"turing", "turing:production", "schnakenberg", "gray-scott", "brusselator"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Models, TuringSplitIsThatOfThePaper) {
  // Fig. 2 of Bajaj, Zhang, Xu 2008: a: C2 = -s b, C3 = 16 s; b: C2 = s (a - 1), C3 = -s beta.
  const Model model = compile(load_model("turing"), {{"unevenness", 0}});
  const std::vector<Point> points = {{0, 0, 0}, {1, 2, 3}};
  const Kinetics kinetics(model, {.positions = points}, 1);
  const std::vector<double> a = {1.5, 7}, b = {2.5, 0.25};
  std::vector<double> c2a(2), c2b(2), c3a(2), c3b(2);
  const double* u[] = {a.data(), b.data()};
  double *c2[] = {c2a.data(), c2b.data()}, *c3[] = {c3a.data(), c3b.data()};
  kinetics.split(u, 0, 0, 2, c2, c3);
  const double s = 0.05;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_DOUBLE_EQ(c2a[i], -s * b[i]);
    EXPECT_DOUBLE_EQ(c3a[i], 16 * s);
    EXPECT_DOUBLE_EQ(c2b[i], s * (a[i] - 1));
    EXPECT_DOUBLE_EQ(c3b[i], -s * 12);
  }
}

TEST(Models, UnknownNames) {
  EXPECT_EQ(error_of("turnig"), "unknown model \"turnig\"; did you mean \"turing\"?");
  EXPECT_NE(error_of("qqq").find("there are baer-eiswirth"), std::string::npos);
  EXPECT_EQ(error_of("turing:prodution"), "unknown model \"turing:prodution\"; did you mean \"turing:production\"?");
  EXPECT_EQ(error_of("/none.toml", Fault::input), "/none.toml: cannot be read; check the path");
  const std::string folder = std::string(PELAGE_BINARY_DIR) + "/test-files/models-test.toml";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(error_of(folder + ":variant", Fault::input), folder + ": is a folder; give the path of a .toml file");
}

TEST(Models, DamagedTextsAreFaultsAndNothingWorse) {
  const std::string pieces[] = {"(", ")", "^",      "-",    "u",  "9",    "\"",  "[",
                                "=", ",", "noise(", "not ", "\n", "\xFF", "1e9", "if("};
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.path.starts_with("models/")) continue;
    for (std::uint64_t trial = 0; trial < 400; ++trial) {
      std::string text(file.text);
      for (std::uint64_t edit = 0; edit <= trial % 4; ++edit) {
        const std::uint64_t key = hash(trial, edit);
        const std::size_t at = key % text.size();
        text.replace(at, (key >> 32) % 5, pieces[(key >> 40) % std::size(pieces)]);
      }
      try {
        const Model model = compile(parse_model(text, "m.toml"));
        if (trial % 8 == 0) analyse(model);
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        EXPECT_GT(error.where().line, 0) << error.what();
      }
    }
  }
}

TEST(Models, FilesOfTheUser) {
  const std::string path = testing::TempDir() + "pelage_models_test.toml";
  std::ofstream(path) << "name = 'mine'\nspecies.u = { diffusion = 1, rate = '-u' }\nvariants.fast.title = 'F'\n";
  EXPECT_EQ(load_model(path).name, "mine");
  EXPECT_EQ(load_model(path + ":fast").title, "F");
  std::ofstream(path) << "name = 'mine'\nspecies.u = { diffusion = 1, rat = '-u' }\n";
  EXPECT_EQ(error_of(path), path + ":2:30: unknown key \"rat\"; did you mean \"rate\"?");
  std::remove(path.c_str());
}

}  // namespace
}  // namespace pelage
