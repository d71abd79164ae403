#include "react/kinetics.h"

#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "catalog/models.h"
#include "react/place_values.h"
#include "react/support.h"

namespace pelage {
namespace {

constexpr std::size_t samples = 5000;

std::vector<Point> spiral() {
  std::vector<Point> points(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double s = 0.01 * static_cast<double>(i);
    points[i] = {s * std::cos(s), s * std::sin(s), 0.3 * s};
  }
  return points;
}

Model model_of(const std::string& text) { return compile(parse_model("name = 'm'\n" + text, "m.toml")); }

/// A model whose only rate is the text.
Model rate_of(const std::string& rate) { return model_of("[species.u]\ndiffusion = 0\nrate = '" + rate + "'"); }

std::vector<double> rates(const Model& model, const Places& places, std::uint64_t seed, double t = 0, double u = 0) {
  const Kinetics kinetics(model, places, seed);
  std::vector<double> from(places.positions.size(), u), to(from.size());
  const double* in[] = {from.data()};
  double* out[] = {to.data()};
  parallel_for(from.size(), [&](std::size_t begin, std::size_t end) { kinetics.rates(in, t, begin, end, out); });
  return to;
}

TEST(Kinetics, ReadsThePlace) {
  const std::vector<Point> points = {{1, 2, 3}, {4, 5, 6}}, normals = {{0, 0, 1}, {0.6, 0.8, 0}};
  const std::vector<double> k1 = {2, 3}, k2 = {-1, 5}, mask = {7, 8};
  Places places{points, normals, k1, k2, {{"mask", mask}}, 1};
  EXPECT_EQ(rates(rate_of("x + 10*y + 100*z"), places, 1), (std::vector<double>{321, 654}));
  EXPECT_EQ(rates(rate_of("nx + 10*ny + 100*nz"), places, 1), (std::vector<double>{100, 8.6}));
  EXPECT_EQ(rates(rate_of("k1 + 10*k2 + 100*H"), places, 1), (std::vector<double>{42, 453}));
  EXPECT_EQ(rates(rate_of("attribute(mask)*u + t*x"), places, 1, 0.5, 2), (std::vector<double>{14.5, 18}));
  EXPECT_EQ(rates(rate_of("cos(t*0) + u*(t + 1)"), places, 1, 2, 3), (std::vector<double>{10, 10}));
}

TEST(Kinetics, BoundsHoldInitialValuesAndWhatReactionsSee) {
  const Model model = model_of("[species.u]\nmin = -1\nmax = 2\ndiffusion = 0\nrate = '10*u'\ninitial = 'x'\n");
  const std::vector<Point> points = {{-3, 0, 0}, {0.5, 0, 0}, {7, 0, 0}};
  EXPECT_EQ(initial_values(model, 0, {.positions = points}, 1), (std::vector<double>{-1, 0.5, 2}));
  for (const auto& [u, rate] : {std::pair{-3.0, -10.0}, {0.5, 5.0}, {7.0, 20.0}})
    EXPECT_EQ(rates(model, {.positions = points}, 1, 0, u), (std::vector<double>(3, rate)));
}

TEST(Kinetics, PlacesInTheBoundingBoxRunFromMinusOneToOne) {
  const std::vector<Point> points = {{1, 2, 7}, {3, 2, 5}, {2.5, 2, 9}};
  EXPECT_EQ(rates(rate_of("bx"), {.positions = points}, 1), (std::vector<double>{-1, 1, 0.5}));
  EXPECT_EQ(rates(rate_of("by"), {.positions = points}, 1), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(rates(rate_of("bz"), {.positions = points}, 1), (std::vector<double>{0, -1, 1}));
}

TEST(Kinetics, MissingQuantitiesAreLocatedFaults) {
  const std::vector<Point> points = {{1, 2, 3}};
  const std::vector<double> mask = {1};
  const Places places{.positions = points, .attributes = {{"mask", mask}}};
  EXPECT_EQ(error_of([&] { rates(rate_of("u + attribute(msk)"), places, 1); }),
            "m.toml:4:13: the mesh has no vertex attribute \"msk\"; did you mean \"mask\"?");
  EXPECT_EQ(error_of([&] { rates(rate_of("nx"), places, 1); }),
            "m.toml:4:9: the model uses normals, which this surface does not have");
  EXPECT_EQ(error_of([&] { rates(rate_of("2*k2"), places, 1); }),
            "m.toml:4:11: the model uses curvatures, which this surface does not have");
}

TEST(Kinetics, RandomFieldsHaveTheirMoments) {
  const auto points = spiral();
  const Places places{.positions = points};
  const auto moments = [&](const std::string& text) {
    const auto values = rates(rate_of(text), places, 3);
    double mean = 0, square = 0;
    for (const double v : values) mean += v / samples;
    for (const double v : values) square += (v - mean) * (v - mean) / samples;
    return std::pair(mean, square);
  };
  const auto [uniform_mean, uniform_variance] = moments("uniform(2, 5)");
  EXPECT_NEAR(uniform_mean, 3.5, 0.05);
  EXPECT_NEAR(uniform_variance, 9.0 / 12, 0.05);
  const auto [normal_mean, normal_variance] = moments("normal(-1, 2)");
  EXPECT_NEAR(normal_mean, -1, 0.1);
  EXPECT_NEAR(normal_variance, 4, 0.3);
  const auto [noise_mean, noise_variance] = moments("noise(0.3)");
  EXPECT_NEAR(noise_mean, 0, 0.1);
  EXPECT_NEAR(noise_variance, 1, 0.15);
}

TEST(Kinetics, RandomFieldsBelongToPlaceSeedAndOccurrence) {
  const auto points = spiral();
  const std::vector<Point> reversed(points.rbegin(), points.rend());
  for (const char* text : {"uniform(0, 1)", "normal(0, 1)", "noise(2)"}) {
    const Model model = rate_of(text);
    const auto forwards = rates(model, {.positions = points}, 3);
    auto backwards = rates(model, {.positions = reversed}, 3);
    std::reverse(backwards.begin(), backwards.end());
    EXPECT_EQ(forwards, backwards) << text;
    EXPECT_NE(forwards, rates(model, {.positions = points}, 4)) << text;
    const auto difference = rates(rate_of(std::string(text) + " - " + text), {.positions = points}, 3);
    EXPECT_GT(std::fabs(difference[17]), 1e-3) << text;
  }
  const auto same = rates(rate_of("noise(2, 8) - noise(2, 8)"), {.positions = points}, 3);
  EXPECT_EQ(same, std::vector<double>(samples, 0));
}

TEST(Kinetics, NoiseLengthIsInModelUnits) {
  const auto points = spiral();
  std::vector<Point> larger = points;
  for (Point& p : larger)
    for (double& c : p) c *= 8;
  const Model model = rate_of("noise(2)");
  EXPECT_EQ(rates(model, {.positions = points}, 3), rates(model, {.positions = larger, .length_unit = 8}, 3));
}

TEST(Kinetics, ReactionSeesClampedConcentrations) {
  const Model model = model_of("[species.u]\ndiffusion=0\nrate='u^2 + u'\nmin=0\nmax=3\ninitial='-5'");
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const Kinetics kinetics(model, {.positions = points}, 1);
  const std::vector<double> u = {-2, 2, 9};
  std::vector<double> rate(3), c2(3), c3(3), jacobian(3);
  const double* in[] = {u.data()};
  double *r[] = {rate.data()}, *p2[] = {c2.data()}, *p3[] = {c3.data()}, *j[] = {jacobian.data()};
  kinetics.rates(in, 0, 0, 3, r);
  kinetics.split(in, 0, 0, 3, p2, p3);
  kinetics.jacobian(in, 0, 0, 3, j);
  EXPECT_EQ(rate, (std::vector<double>{0, 6, 12}));
  EXPECT_EQ(c2, (std::vector<double>{1, 3, 4}));
  EXPECT_EQ(c3, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(jacobian, (std::vector<double>{1, 5, 7}));
  EXPECT_EQ(initial_values(model, 0, {.positions = points}, 1), (std::vector<double>{0, 0, 0}));
}

TEST(Kinetics, DiffusionMayVary) {
  const Model model = model_of("[species.u]\nC0='1 + x'\nC1='u*(2 + cos(t))'\nrate='0'");
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}};
  const Kinetics kinetics(model, {.positions = points}, 1);
  const std::vector<double> u = {2, 3};
  std::vector<double> c0(2), c1(2);
  const double* in[] = {u.data()};
  double *p0[] = {c0.data()}, *p1[] = {c1.data()};
  kinetics.diffusion(in, 0, 0, 2, p0, p1);
  EXPECT_EQ(c0, (std::vector<double>{1, 2}));
  EXPECT_EQ(c1, (std::vector<double>{6, 9}));
}

TEST(Kinetics, ThreadsAndSlicesDoNotMatter) {
  const auto points = spiral();
  const Model model = rate_of("exp(-u)*noise(1) + sin(x + t)*tanh(u) + u^3");
  const Places places{.positions = points};
  const auto many = rates(model, places, 5, 0.3, 0.7);
  const ThreadLimit one(1);
  EXPECT_EQ(many, rates(model, places, 5, 0.3, 0.7));
  const Kinetics kinetics(model, places, 5);
  std::vector<double> u(samples, 0.7), slices(samples);
  const double* in[] = {u.data()};
  double* out[] = {slices.data()};
  for (std::size_t begin = 0; begin < samples; begin += 333)
    kinetics.rates(in, 0.3, begin, std::min(begin + 333, samples), out);
  EXPECT_EQ(many, slices);
}

TEST(Kinetics, SinglePrecisionReadsEveryFieldOfThePlace) {
  const std::vector<Point> points = {{1, 2, 4}, {2, 3, 5}, {4, 8, 16}};
  const Kinetics kinetics(rate_of("x + 100*y*u + 1000*z"), {.positions = points}, 1);
  const std::vector<float> u = {1, 2};
  std::vector<float> rate(2);
  const float* in[] = {u.data()};
  float* out[] = {rate.data()};
  kinetics.float_rates(0)(in, 1, 2, out);
  EXPECT_EQ(rate, (std::vector<float>{2 + 300 + 5000, 4 + 1600 + 16000}));
}

/// At states around the initial one, relative to the largest rate, which leaves room for terms that cancel.
TEST(Kinetics, RatesOfEveryModelInSinglePrecisionAreThoseInDouble) {
  const std::vector<Point> points = spiral();
  std::vector<double> zero(points.size(), 0.1);
  for (const ModelEntry& entry : model_list()) {
    const Model model = compile(entry.source);
    Places places{.positions = points, .normals = points, .k1 = zero, .k2 = zero, .mask = zero};
    for (const Symbol& s : place_symbols(model))
      if (s.kind == Symbol::Kind::attribute) places.attributes[s.name] = zero;
    const Kinetics kinetics(model, places, 3);
    const std::size_t n = kinetics.species_count();
    std::vector<std::vector<double>> u(n, std::vector<double>(samples)), rate = u;
    std::vector<std::vector<float>> single(n, std::vector<float>(samples)), single_rate = single;
    std::vector<const double*> in;
    std::vector<double*> out;
    std::vector<const float*> single_in;
    std::vector<float*> single_out;
    for (std::size_t i = 0; i < n; ++i) {
      u[i] = initial_values(model, i, places, 3);
      for (std::size_t k = 0; k < samples; ++k) {
        single[i][k] = static_cast<float>(u[i][k] * (1 + 0.2 * std::sin(0.1 * static_cast<double>(k + 7 * i))));
        u[i][k] = single[i][k];
      }
      in.push_back(u[i].data());
      out.push_back(rate[i].data());
    }
    constexpr std::size_t first = 321, count = 1000;
    for (std::size_t i = 0; i < n; ++i) {
      single_in.push_back(single[i].data() + first);
      single_out.push_back(single_rate[i].data());
    }
    const std::vector<double> gradients(samples, 0.25);
    const std::vector<float> single_gradients(samples, 0.25f);
    in.resize(kinetics.input_count(), gradients.data());
    single_in.resize(kinetics.input_count(), single_gradients.data());
    kinetics.rates(in, 0.7, 0, samples, out);
    kinetics.float_rates(0.7)(single_in, first, count, single_out);
    for (std::size_t i = 0; i < n; ++i) {
      double largest = 0;
      for (const double r : rate[i]) largest = std::max(largest, std::abs(r));
      for (std::size_t k = 0; k < count; ++k)
        ASSERT_NEAR(single_rate[i][k], rate[i][first + k], 2e-6 * largest + 1e-30) << entry.name << " species " << i;
    }
  }
}

}  // namespace
}  // namespace pelage
