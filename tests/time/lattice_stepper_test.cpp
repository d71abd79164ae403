// Steppers for even grids: etd, gaussian and binary.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "support/lattice_system.h"
#include "support/steppers.h"
#include "time/exponential.h"

namespace pelage {
namespace {

using std::numbers::pi;

Lattice torus(std::size_t n, std::size_t m) { return {{n, m, 1}, {true, true, false}, {0.5, 0.25, 1}}; }

/// Spreads twice as far, measured by lengths, along the line at `angle` as across.
Eigen::Matrix3d along(double angle) {
  const Eigen::Vector3d d(std::cos(angle), std::sin(angle), 0), n(-d[1], d[0], 0);
  return 0.04 * d * d.transpose() + 0.01 * n * n.transpose();
}

LatticeSystem::Split decay(double b) {
  return [b](const std::vector<double>&, double, std::vector<double>& c2, std::vector<double>&) { c2[0] = -b; };
}

void fitzhugh_nagumo(const std::vector<double>& u, double t, std::vector<double>& c2, std::vector<double>& c3) {
  c2 = {1 - u[0] * u[0], -0.5};
  c3 = {-u[1] + 0.1 * std::sin(3 * t), u[0] / 2};
}

double smooth(std::size_t i, std::size_t j, std::size_t) {
  return std::sin(2 * pi * static_cast<double>(i) / 16) + 0.3 * std::cos(2 * pi * static_cast<double>(j) / 24) + 0.1;
}

void advance(LatticeSystem& s, Stepper& stepper, int steps, double time) {
  for (int k = 0; k < steps; ++k) ASSERT_TRUE(stepper.step(s.system, s.state, {.dt = time / steps}).accepted) << k;
}

class EveryLatticeStepper : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Steppers, EveryLatticeStepper, ::testing::Values("etd", "gaussian"),
                         [](const auto& name) { return stepper_test_name(name); });

/// exp(-(k.Tk + b) t) cos(k.x), whatever the angle and the step.
TEST_P(EveryLatticeStepper, OneWaveDecaysAsItShould) {
  const double b = 0.3, time = 0.7;
  for (const auto& [mx, my] : {std::pair{1, 0}, {0, 3}, {2, 5}, {3, -4}, {7, 11}}) {
    LatticeSystem s(torus(16, 24));
    const auto wave = [mx = mx, my = my](std::size_t i, std::size_t j, std::size_t) {
      return std::cos(2 * pi * (mx * static_cast<double>(i) / 16 + my * static_cast<double>(j) / 24) + 0.2);
    };
    const Eigen::Matrix3d tensor = along(0.4);
    s.add_species(tensor, wave);
    s.set_reaction(decay(b));
    const Vector before = s.state.now[0];
    advance(s, *make_stepper(GetParam()), 3, time);
    const Eigen::Vector3d k(2 * pi * mx / (16 * 0.5), 2 * pi * my / (24 * 0.25), 0);
    EXPECT_LT((s.state.now[0] - std::exp(-(k.dot(tensor * k) + b) * time) * before).cwiseAbs().maxCoeff(), 2e-14);
  }
}

/// The same in a closed box of three dimensions, for a cosine.
TEST_P(EveryLatticeStepper, ACosineDecaysInAClosedBox) {
  const Lattice box{{9, 5, 4}, {false, false, true}, {0.5, 0.25, 1}};
  LatticeSystem s(box);
  s.add_species(Eigen::Vector3d(0.1, 0.02, 0.3).asDiagonal(), [](std::size_t i, std::size_t j, std::size_t k) {
    return std::cos(pi * 3 * static_cast<double>(i) / 8) * std::cos(pi * 2 * static_cast<double>(j) / 4) *
           std::sin(2 * pi * static_cast<double>(k) / 4);
  });
  const Vector before = s.state.now[0];
  advance(s, *make_stepper(GetParam()), 2, 0.5);
  const double rate = 0.1 * std::pow(3 * pi / 4, 2) + 0.02 * std::pow(2 * pi, 2) + 0.3 * std::pow(pi / 2, 2);
  EXPECT_LT((s.state.now[0] - std::exp(-rate * 0.5) * before).cwiseAbs().maxCoeff(), 2e-14);
}

TEST_P(EveryLatticeStepper, DiffusionKeepsTheAmount) {
  LatticeSystem s(torus(15, 22));
  s.add_species(along(1), [](std::size_t i, std::size_t j, std::size_t) { return uniform(i, j); });
  const double before = s.state.now[0].mean();
  advance(s, *make_stepper(GetParam()), 50, 20);
  EXPECT_NEAR(s.state.now[0].mean() / before, 1, 1e-14);
  EXPECT_LT(s.state.now[0].maxCoeff() - s.state.now[0].minCoeff(), 0.2);
}

/// What grows between mirrors is what grows on the torus of the field and its mirror images.
TEST_P(EveryLatticeStepper, ClosedBordersAreMirrors) {
  const std::size_t n = 9, m = 7;
  LatticeSystem closed({{n, m, 1}, {false, false, false}, {0.5, 0.25, 1}});
  LatticeSystem whole(torus(2 * (n - 1), 2 * (m - 1)));
  const auto start = [&](std::size_t i, std::size_t j) { return uniform(3, i + n * j); };
  for (double diffusion : {0.1, 0.02}) {
    closed.add_species(diffusion * Eigen::Matrix3d::Identity(),
                       [&](std::size_t i, std::size_t j, std::size_t) { return start(i, j); });
    whole.add_species(diffusion * Eigen::Matrix3d::Identity(), [&](std::size_t i, std::size_t j, std::size_t) {
      return start(std::min(i, 2 * (n - 1) - i), std::min(j, 2 * (m - 1) - j));
    });
  }
  for (LatticeSystem* s : {&closed, &whole}) {
    s->set_reaction(fitzhugh_nagumo);
    advance(*s, *make_stepper(GetParam()), 20, 2);
  }
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(closed.state.now[0][static_cast<Eigen::Index>(i + n * j)],
                  whole.state.now[0][static_cast<Eigen::Index>(i + 2 * (n - 1) * j)], 1e-13);
}

/// A tile that is cut elsewhere grows the same pattern there, to rounding.
TEST_P(EveryLatticeStepper, AShiftedTileGrowsTheShiftedPattern) {
  const std::size_t n = 16, m = 24;
  LatticeSystem a(torus(n, m)), b(torus(n, m));
  for (double angle : {0.3, 1.2}) {
    a.add_species(along(angle), [&](std::size_t i, std::size_t j, std::size_t) { return uniform(i, j) - 0.5; });
    b.add_species(along(angle), [&](std::size_t i, std::size_t j, std::size_t) {
      return uniform((i + n / 2) % n, (j + m / 2) % m) - 0.5;
    });
  }
  for (LatticeSystem* s : {&a, &b}) {
    s->set_reaction(fitzhugh_nagumo);
    advance(*s, *make_stepper(GetParam()), 20, 2);
  }
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(a.state.now[0][static_cast<Eigen::Index>((i + n / 2) % n + n * ((j + m / 2) % m))],
                  b.state.now[0][static_cast<Eigen::Index>(i + n * j)], 1e-13);
}

/// The order from three runs whose steps are halved.
double observed_order(const std::string& name, int steps) {
  std::vector<Vector> end;
  for (int parts : {1, 2, 4}) {
    LatticeSystem s(torus(16, 24));
    s.add_species(along(0.4), smooth);
    s.add_species(Eigen::Matrix3d::Zero(), [](auto...) { return 0.2; });
    s.set_reaction(fitzhugh_nagumo);
    advance(s, *make_stepper(name), parts * steps, 2);
    end.push_back(s.state.now[0]);
  }
  return std::log2((end[0] - end[1]).norm() / (end[1] - end[2]).norm());
}

TEST(Etd, IsOfThirdOrder) { EXPECT_NEAR(observed_order("etd", 16), 3, 0.15); }
TEST(Gaussian, IsOfFirstOrder) { EXPECT_NEAR(observed_order("gaussian", 64), 1, 0.1); }

/// The estimate is the error of the scheme of second order inside: it falls with the third power of the step.
TEST(Etd, EstimatesTheErrorOfAStep) {
  const auto estimate = [](double dt) {
    LatticeSystem s(torus(16, 24));
    s.add_species(along(0.4), smooth);
    s.add_species(Eigen::Matrix3d::Zero(), [](auto...) { return 0.2; });
    s.set_reaction(fitzhugh_nagumo);
    return make_stepper("etd")->step(s.system, s.state, {.dt = dt}).error;
  };
  EXPECT_NEAR(std::log2(estimate(0.02) / estimate(0.01)), 3, 0.1);
  EXPECT_GT(estimate(0.1), 1e-6);
}

TEST(Etd, RejectsAStepAboveTheLargestErrorAndLeavesTheState) {
  LatticeSystem s(torus(16, 24));
  s.add_species(along(0.4), smooth);
  s.add_species(Eigen::Matrix3d::Zero(), [](auto...) { return 0.2; });
  s.set_reaction(fitzhugh_nagumo);
  const Vector before = s.state.now[0];
  const StepReport report = make_stepper("etd")->step(s.system, s.state, {.dt = 1, .largest_error = 1e-9});
  EXPECT_FALSE(report.accepted);
  EXPECT_TRUE(report.failure.empty());
  EXPECT_EQ(s.state.now[0], before);
  EXPECT_EQ(s.state.step, 0);
}

TEST_P(EveryLatticeStepper, ClampsHold) {
  LatticeSystem s(torus(6, 8));
  s.add_species(along(0), [](std::size_t i, auto...) { return 0.01 * static_cast<double>(i); });
  s.system.species[0].lower = 0;
  s.set_reaction([](const std::vector<double>&, double, std::vector<double>&, std::vector<double>& c3) { c3[0] = -1; });
  const StepReport report = make_stepper(GetParam())->step(s.system, s.state, {.dt = 0.1});
  EXPECT_TRUE(report.accepted);
  EXPECT_EQ(s.state.now[0].cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(report.maximum, 0);
}

TEST_P(EveryLatticeStepper, BlowUpIsAnAnswerAndLeavesTheState) {
  LatticeSystem s(torus(6, 8));
  s.add_species(along(0), [](auto...) { return 1e110; });
  s.set_reaction([](const std::vector<double>& u, double, std::vector<double>&, std::vector<double>& c3) {
    c3[0] = u[0] * u[0] * u[0];
  });
  const StepReport report = make_stepper(GetParam())->step(s.system, s.state, {.dt = 1});
  EXPECT_FALSE(report.accepted);
  EXPECT_FALSE(report.failure.empty());
  EXPECT_EQ(s.state.now[0].minCoeff(), 1e110);
}

TEST_P(EveryLatticeStepper, RefusesWhatItCannotDo) {
  const auto refusal = [&](const std::function<void(LatticeSystem&)>& change) {
    LatticeSystem s({{6, 8, 1}, {true, false, false}, {1, 1, 1}});
    s.add_species(along(0), [](auto...) { return 1.0; });
    change(s);
    const StepReport report = make_stepper(GetParam())->step(s.system, s.state, {.dt = 0.1});
    EXPECT_EQ(report.accepted, report.failure.empty());
    EXPECT_EQ(report.refused, !report.accepted);
    return report.failure;
  };
  EXPECT_EQ(refusal([](LatticeSystem&) {}), "");
  EXPECT_NE(refusal([](LatticeSystem& s) { s.system.species[0].tensor = along(0.1); }).find("closed border"),
            std::string::npos);
  EXPECT_NE(refusal([](LatticeSystem& s) { s.system.species[0].tensor.reset(); }).find("not the same everywhere"),
            std::string::npos);
  EXPECT_NE(refusal([](LatticeSystem& s) { s.system.lattice = nullptr; }).find("even grid"), std::string::npos);
  EXPECT_NE(refusal([](LatticeSystem& s) { s.system.held = std::make_shared<Held>(); }).find("hold"),
            std::string::npos);
}

constexpr std::size_t tile = 48;

/// The zebra pair of Witkin and Kass: p and q spread twice as far along a line as p does across, q 1.5 times as far
/// across.
void add_zebra(LatticeSystem& s, double angle, std::size_t shift) {
  for (const double across : {1.5, 1.0}) {
    const Eigen::Vector3d d(std::cos(angle), std::sin(angle), 0), n(-d[1], d[0], 0);
    s.add_species(4 * d * d.transpose() + across * across * n * n.transpose(), [&](std::size_t i, std::size_t j,
                                                                                   std::size_t) {
      return 2 * uniform(static_cast<std::uint64_t>(10 * across), (i + shift) % tile + tile * ((j + shift) % tile)) - 1;
    });
  }
  s.set_reaction([](const std::vector<double>& u, double, std::vector<double>& c2, std::vector<double>& c3) {
    c2 = {-1, -1};
    c3[0] = c3[1] = u[1] > u[0] ? 1 : 0;
  });
}

std::vector<char> bits_of(const LatticeSystem& s) {
  std::vector<char> bits;
  for (Eigen::Index n = 0; n < s.state.now[0].size(); ++n) bits.push_back(s.state.now[1][n] > s.state.now[0][n]);
  return bits;
}

/// What it comes to rest at is a steady state for a scheme of time that knows nothing of it.
TEST(SignIteration, ComesToRestAtASteadyStateOfTheEquations) {
  LatticeSystem s({{tile, tile, 1}, {true, true, false}, {1, 1, 1}});
  add_zebra(s, 0.5, 0);
  const auto stepper = make_stepper("sign-iteration");
  double change = 1;
  for (int step = 0; step < 20 && change > 0; ++step) {
    const StepReport report = stepper->step(s.system, s.state, {.dt = 1});
    ASSERT_TRUE(report.accepted) << report.failure;
    change = report.change;
  }
  EXPECT_EQ(change, 0);
  const std::vector<Vector> rest = s.state.now;
  EXPECT_GT((rest[1] - rest[0]).cwiseAbs().mean(), 0.05);
  advance(s, *make_stepper("etd"), 3, 1.5);
  for (std::size_t i : {0, 1}) EXPECT_LT((s.state.now[i] - rest[i]).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SignIteration, NeedsADecayAtAConstantRate) {
  LatticeSystem s(torus(6, 8));
  s.add_species(along(0), [](auto...) { return 1.0; });
  s.set_reaction([](const std::vector<double>&, double, std::vector<double>& c2, std::vector<double>&) { c2[0] = 1; });
  EXPECT_NE(make_stepper("sign-iteration")->step(s.system, s.state, {.dt = 1}).failure.find("decay"),
            std::string::npos);
}

/// Every bit is the sign of the difference of two Gaussians, of the time for which their waves peak at 2 pi sqrt(1.5),
/// summed over the bits before, 25 times a step.
TEST(Binary, IteratesADifferenceOfGaussiansOnBits) {
  LatticeSystem s({{tile, tile, 1}, {true, true, false}, {1, 1, 1}});
  add_zebra(s, 0.5, 0);
  const auto stepper = make_stepper("binary");
  ASSERT_TRUE(stepper->step(s.system, s.state, {.dt = 1}).accepted);
  const double time = 1.5 * std::log(2.25) / 1.25;
  std::vector<double> difference(tile * tile);
  for (std::size_t k = 0; k < difference.size(); ++k)
    for (int px = -1; px <= 1; ++px)
      for (int py = -1; py <= 1; ++py) {
        const Eigen::Vector2d p(static_cast<double>(k % tile) + px * static_cast<double>(tile),
                                static_cast<double>(k / tile) + py * static_cast<double>(tile));
        for (std::size_t i : {0, 1}) {
          const Eigen::Matrix2d t = s.system.species[i].tensor->topLeftCorner<2, 2>();
          difference[k] += (i == 1 ? 1 : -1) * std::exp(-p.dot(t.inverse() * p) / (4 * time)) /
                           (4 * pi * time * std::sqrt(t.determinant()));
        }
      }
  const auto next_of = [&](const std::vector<char>& bits) {
    std::vector<char> next(bits.size());
    for (std::size_t k = 0; k < bits.size(); ++k) {
      double sum = 0;
      for (std::size_t other = 0; other < bits.size(); ++other)
        if (bits[other])
          sum += difference[(other % tile + tile - k % tile) % tile + tile * ((other / tile + tile - k / tile) % tile)];
      next[k] = sum > 0;
    }
    return next;
  };
  for (int step = 0; step < 2; ++step) {
    std::vector<char> expected = bits_of(s);
    for (int round = 0; round < 25; ++round) expected = next_of(expected);
    ASSERT_TRUE(stepper->step(s.system, s.state, {.dt = 1}).accepted);
    const std::vector<char> bits = bits_of(s);
    int differ = 0;
    for (std::size_t k = 0; k < bits.size(); ++k) differ += bits[k] != expected[k];
    EXPECT_LT(differ, 30) << step;  // of 2304: kernels of four deviations in whole numbers leave a little out
  }
}

/// Whole numbers do not know where a tile begins: the pattern moves with it bit by bit until it is at rest.
TEST(Binary, AShiftedTileGrowsTheShiftedBits) {
  std::vector<std::vector<char>> bits;
  for (const std::size_t shift : {std::size_t{0}, tile / 2}) {
    LatticeSystem s({{tile, tile, 1}, {true, true, false}, {1, 1, 1}});
    add_zebra(s, 0.5, shift);
    const auto stepper = make_stepper("binary");
    StepReport report;
    for (int k = 0; k < 200 && (k == 0 || report.change > 0); ++k)
      report = stepper->step(s.system, s.state, {.dt = 0.2});
    EXPECT_EQ(report.change, 0);
    EXPECT_LT(s.state.step, 10);
    bits.push_back(bits_of(s));
  }
  const auto share = static_cast<double>(std::ranges::count(bits[0], 1)) / (tile * tile);
  EXPECT_NEAR(share, 0.5, 0.1);
  for (std::size_t k = 0; k < tile * tile; ++k)
    ASSERT_EQ(bits[0][(k % tile + tile / 2) % tile + tile * ((k / tile + tile / 2) % tile)], bits[1][k]);
}

/// It goes on from the fields alone.
TEST(Binary, AFreshStepperGoesOnBitForBit) {
  std::vector<Vector> end;
  for (const bool fresh : {false, true}) {
    LatticeSystem s({{tile, tile, 1}, {true, true, false}, {1, 1, 1}});
    add_zebra(s, 0.5, 0);
    auto stepper = make_stepper("binary");
    for (int k = 0; k < 8; ++k) {
      if (fresh) stepper = make_stepper("binary");
      ASSERT_TRUE(stepper->step(s.system, s.state, {.dt = 0.2}).accepted);
    }
    end.push_back(s.state.now[0]);
  }
  EXPECT_EQ(end[0], end[1]);
}

TEST(Binary, RefusesOtherModels) {
  const auto refusal = [](const LatticeSystem::Split& reaction) {
    LatticeSystem s({{tile, tile, 1}, {true, true, false}, {1, 1, 1}});
    add_zebra(s, 0.5, 0);
    s.set_reaction(reaction);
    return make_stepper("binary")->step(s.system, s.state, {.dt = 1}).failure;
  };
  using List = std::vector<double>;
  EXPECT_NE(refusal([](const List&, double, List&, List& c3) { c3 = {1, 1}; }).find("decay"), std::string::npos);
  EXPECT_NE(refusal([](const List& u, double, List& c2, List& c3) {
              c2 = {-1, -1}, c3 = {u[0], u[0]};
            }).find("made"),
            std::string::npos);
  EXPECT_NE(refusal([](const List& u, double, List& c2, List& c3) {
              c2 = {-1, -1};
              c3[0] = c3[1] = u[1] > u[0] + 0.1 ? 1.0 : 0.0;
            }).find("u2 is more than u1"),
            std::string::npos);
  LatticeSystem one({{tile, tile, 1}, {true, true, false}, {1, 1, 1}});
  one.add_species(along(0), [](auto...) { return 1.0; });
  EXPECT_NE(make_stepper("binary")->step(one.system, one.state, {.dt = 1}).failure.find("pairs"), std::string::npos);
}

/// Against the integral of exp((1 - s) z) s^(k-1) / (k-1)! over s from 0 to 1, by Simpson's rule.
TEST(PhiFunctions, AreTheirIntegrals) {
  for (const double z : {-30.0, -3.0, -1.0000001, -0.9999999, -0.1, -1e-9, 0.0, 1e-4, 0.5, 2.0}) {
    const auto integral = [z](auto&& weight) {
      constexpr int n = 2000;
      double sum = 0;
      for (int i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n;
        sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * std::exp((1 - s) * z) * weight(s);
      }
      return sum / (3 * n);
    };
    const Phi p = phi_functions(z);
    EXPECT_NEAR(p.exp, std::exp(z), 4e-16 * std::exp(z) + 1e-16) << z;
    EXPECT_NEAR(p.phi1, integral([](double) { return 1.0; }), 1e-9 * p.phi1) << z;
    EXPECT_NEAR(p.phi2, integral([](double s) { return s; }), 1e-9 * p.phi2) << z;
    EXPECT_NEAR(p.phi3, integral([](double s) { return s * s / 2; }), 1e-9 * p.phi3) << z;
    EXPECT_NEAR(p.half_phi1, phi_functions(z / 2).phi1, 1e-14 * p.half_phi1) << z;
  }
}

}  // namespace
}  // namespace pelage
