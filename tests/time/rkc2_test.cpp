#include "time/rkc2.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "discretise/surface_space.h"
#include "shape/generators.h"
#include "support/steppers.h"
#include "time/chebyshev.h"
#include "verify/problem.h"

namespace pelage {
namespace {

using Rates = std::function<void(const std::vector<double>& u, double t, std::vector<double>& rate)>;

/// Linear elements on a sphere.
struct NodalBench {
  explicit NodalBench(std::size_t n = 642, bool half_consistent = true)
      : problem(make_problem(builtin_shape("builtin:sphere?n=" + std::to_string(n)), make_linear, false)) {
    const SampledMass sampled =
        surface_space(problem.discretisation, problem.control, 2)->sampled(SampleRule::vertices);
    system.sampling = sampled.sampling;
    system.mass = sampled.mass;
    if (half_consistent) {
      SparseMatrix mass = *sampled.mass;
      combine(0.5, *sampled.mass, 0.5, problem.mass, mass);
      system.mass = std::make_shared<const SparseMatrix>(mass);
    }
    stiffness = std::make_shared<const SparseMatrix>(problem.stiffness);
    react([](const std::vector<double>&, double, std::vector<double>& rate) { std::ranges::fill(rate, 0); });
  }
  NodalBench(const NodalBench&) = delete;
  NodalBench& operator=(const NodalBench&) = delete;

  void add(double diffusion, const std::function<double(const Point&)>& start) {
    Species& s = system.species.emplace_back();
    s.name = "u" + std::to_string(system.species.size());
    s.diffusion = diffusion;
    s.stiffness = stiffness;
    Vector u(problem.discretisation.unknowns);
    for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = start(problem.control[static_cast<std::size_t>(k)]);
    state.now.push_back(u);
  }

  void react(Rates rates) {
    system.reaction.rates = [rates = std::move(rates)](const FieldPointers& u, double t, std::size_t begin,
                                                       std::size_t end, const MutableFieldPointers& rate) {
      std::vector<double> value(u.size()), r(u.size());
      for (std::size_t s = begin; s < end; ++s) {
        for (std::size_t i = 0; i < u.size(); ++i) value[i] = u[i][s];
        rates(value, t, r);
        for (std::size_t i = 0; i < u.size(); ++i) rate[i][s] = r[i];
      }
    };
  }

  /// FitzHugh-Nagumo with two species that diffuse, and on request a third that drives the first.
  void react_with_waves(bool third = false) {
    add(0.02, [](const Point& x) { return 0.5 + 0.3 * x[0] - 0.2 * x[1] * x[2]; });
    add(0.1, [](const Point& x) { return 0.2 * x[2]; });
    if (third) add(0.05, [](const Point& x) { return 0.1 + 0.05 * x[1]; });
    react([third](const std::vector<double>& u, double, std::vector<double>& rate) {
      rate[0] = u[0] - u[0] * u[0] * u[0] - u[1] + (third ? u[2] : 0);
      rate[1] = (u[0] - u[1]) / 2;
      if (third) rate[2] = u[0] * u[1] - u[2];
    });
  }

  /// The state after `steps` steps up to `end`.
  State run(Stepper& stepper, double end, int steps) const {
    State s = state;
    for (int k = 0; k < steps; ++k) {
      const StepReport report = stepper.step(system, s, {.dt = end / steps, .solver_tolerance = 1e-13});
      EXPECT_TRUE(report.accepted) << report.failure;
    }
    return s;
  }
  double amount(const State& s, std::size_t i) const { return dot(system.sampling->weight, s.now[i]); }

  Problem problem;
  SharedMatrix stiffness;
  System system;
  State state;
};

double relative(const Vector& a, const Vector& b) { return (a - b).norm() / b.norm(); }

TEST(Chebyshev, PolynomialsAreOfSecondOrderAndDampedInTheirInterval) {
  for (int s = 2; s < 60; s += 3) {
    const auto stages = chebyshev_stages(s);
    const auto polynomial = [&](double z) {
      double before = 0, d = stages[1].rate * z;
      for (std::size_t j = 2; j < stages.size(); ++j) {
        const ChebyshevStage& c = stages[j];
        before = c.mu * d + c.nu * before + c.rate * z * (1 + d) + c.first * z;
        std::swap(before, d);
      }
      return 1 + d;
    };
    const double z = 1e-3;
    EXPECT_NEAR((polynomial(z) - 1 - z - z * z / 2) / (z * z), 0, 2e-3) << s;
    double stiffness = 0;
    while (chebyshev_stage_count(stiffness + 0.01) <= s) stiffness += 0.01;
    for (double x = 0.1; x < stiffness; x += 0.1) EXPECT_LT(std::abs(polynomial(-x)), 1) << s << " at " << x;
    EXPECT_NEAR(stages.back().time, 1, 1e-12);
  }
}

TEST(Rkc2, IsOfSecondOrder) {
  for (const bool third : {false, true}) {
    NodalBench bench(642, false);
    bench.react_with_waves(third);
    const State exact = bench.run(*make_stepper("sbdf2"), 2, 4000);
    const auto error = [&](int steps) {
      const State s = bench.run(*make_rkc2(), 2, steps);
      double worst = 0;
      for (std::size_t i = 0; i < s.now.size(); ++i) worst = std::max(worst, relative(s.now[i], exact.now[i]));
      return worst;
    };
    const double coarse = error(5), middle = error(10), fine = error(20);
    EXPECT_NEAR(std::log2(coarse / middle), 2, 0.35);
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.25);
    EXPECT_LT(error(80), 1e-4);
  }
}

/// du/dt = cos(3 t) u: exp(sin(3 t) / 3).
TEST(Rkc2, TakesTimeDependentRatesAtSecondOrder) {
  NodalBench bench(162);
  bench.add(0.1, [](const Point&) { return 1; });
  bench.react(
      [](const std::vector<double>& u, double t, std::vector<double>& rate) { rate[0] = std::cos(3 * t) * u[0]; });
  const auto error = [&](int steps) {
    return std::abs(bench.run(*make_rkc2(), 2, steps).now[0].mean() - std::exp(std::sin(6.0) / 3));
  };
  EXPECT_NEAR(std::log2(error(80) / error(160)), 2, 0.2);
}

TEST(Rkc2, SweepsApproachTheInverseOfTheMass) {
  NodalBench bench;
  bench.add(1, [](const Point& x) { return std::sin(12 * x[0]) * std::cos(9 * x[1]); });
  const double dt = 1e-5;
  const auto slope = [&](Stepper& s) -> Vector { return (bench.run(s, dt, 1).now[0] - bench.state.now[0]) / dt; };
  const Vector exact = slope(*make_stepper("explicit"));
  std::vector<double> error;
  for (const int sweeps : {0, 1, 2, 4, 12}) error.push_back(relative(slope(*make_rkc2({.sweeps = sweeps})), exact));
  EXPECT_GT(error[0], 0.05);
  EXPECT_LT(error[1], 0.3 * error[0]);
  EXPECT_LT(error[2], 0.3 * error[1]);
  EXPECT_LT(error[3], 0.3 * error[2]);
  EXPECT_LT(error[4], 2e-3);
}

TEST(Rkc2, AgreesWithSmallStepsOfEuler) {
  NodalBench bench(162, false);
  bench.react_with_waves();
  const State exact = bench.run(*make_stepper("explicit"), 1, 4000);
  const State s = bench.run(*make_rkc2(), 1, 50);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(relative(s.now[i], exact.now[i]), 2e-4);
}

TEST(Rkc2, KeepsTheAmountAndStaysStableWithManyStages) {
  NodalBench bench;
  bench.add(1, [](const Point& x) { return 1 + 0.3 * x[0] + 0.2 * std::sin(40 * x[1]); });
  for (const double dt : {0.01, 1.0, 30.0}) {
    const auto stepper = make_rkc2();
    State s = bench.state;
    double range = s.now[0].maxCoeff() - s.now[0].minCoeff();
    for (int k = 0; k < 20; ++k) {
      const StepReport report = stepper->step(bench.system, s, {.dt = dt});
      ASSERT_TRUE(report.accepted) << report.failure;
      const double now = report.maximum - report.minimum;
      EXPECT_LE(now, range * 1.02 + 1e-6);
      range = now;
    }
    EXPECT_NEAR(bench.amount(s, 0) / bench.amount(bench.state, 0), 1, 2e-6) << dt;
  }
}

TEST(Rkc2, GivesTheSameBitsForAnyThreadsAndInstructions) {
  NodalBench bench(5000);
  bench.react_with_waves(true);
  bench.system.species[1].stiffness = std::make_shared<const SparseMatrix>(bench.problem.stiffness);  // of its own
  for (const int sweeps : {1, 2}) {
    std::vector<State> results;
    for (const InstructionSet set : instruction_sets())
      for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        results.push_back(bench.run(*make_rkc2({.sweeps = sweeps, .instructions = set}), 1, 5));
      }
    for (const State& s : results)
      for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(s.now[i] == results[0].now[i]);
  }
}

/// Two species with operators of their own share a register; each must come out as if it were alone.
TEST(Rkc2, SpeciesOfDifferentOperatorsGrowAsEachAlone) {
  NodalBench both(2000);
  SparseMatrix scaled = both.problem.stiffness;
  for (double& value : scaled.value) value *= 3;
  const auto wave = [](const Point& x) { return 0.5 + 0.3 * x[0] - 0.2 * x[1] * x[2]; };
  both.add(0.02, wave);
  both.add(0.02, wave);
  both.system.species[1].stiffness = std::make_shared<const SparseMatrix>(scaled);
  const State together = both.run(*make_rkc2(), 1, 10);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    NodalBench alone(2000);
    alone.add(0.02, wave);
    alone.system.species[0].stiffness = both.system.species[i].stiffness;
    EXPECT_LT(relative(alone.run(*make_rkc2(), 1, 10).now[0], together.now[i]), 1e-5) << i;
  }
  EXPECT_GT(relative(together.now[0], together.now[1]), 1e-2);
}

/// A rate that is 0 or 1 has no slope but where it jumps: it must not cost more evaluations than none.
TEST(Rkc2, AJumpIsNoStiffness) {
  const auto evaluations = [](bool jumps) {
    NodalBench bench(642);
    bench.add(0.02, [](const Point& x) { return x[0]; });
    bench.react([jumps](const std::vector<double>& u, double, std::vector<double>& rate) {
      rate[0] = jumps && u[0] > 0 ? 1 : 0;
    });
    bench.system.reaction.float_jacobian = [](double) -> FloatRates {
      return [](std::span<const float* const>, std::size_t, std::size_t count, std::span<float* const> slope) {
        std::fill_n(slope[0], count, 0.0f);
      };
    };
    State s = bench.state;
    return make_rkc2()->step(bench.system, s, {.dt = 1}).iterations;
  };
  EXPECT_EQ(evaluations(true), evaluations(false));
}

/// And a root that begins with an unbounded slope must not make steps impossible.
TEST(Rkc2, ARootIsNoInfiniteStiffness) {
  NodalBench bench(162);
  bench.add(0.01, [](const Point& x) { return std::max(0.0, x[0]); });
  bench.react([](const std::vector<double>& u, double, std::vector<double>& rate) { rate[0] = -std::sqrt(u[0]); });
  bench.system.reaction.float_jacobian = [](double) -> FloatRates {
    return [](std::span<const float* const> u, std::size_t, std::size_t count, std::span<float* const> slope) {
      for (std::size_t k = 0; k < count; ++k) slope[0][k] = -0.5f / std::sqrt(u[0][k]);
    };
  };
  bench.system.species[0].lower = 0;
  State s = bench.state;
  const StepReport report = make_rkc2()->step(bench.system, s, {.dt = 0.1});
  EXPECT_TRUE(report.accepted) << report.failure;
  EXPECT_LT(report.iterations, 50);
}

TEST(Rkc2, ContinuesFromTheStateAlone) {
  NodalBench bench;
  bench.react_with_waves(true);
  const auto stepper = make_rkc2();
  State s = bench.state, copy;
  const auto steps = [&](Stepper& by, State& of, int count) {
    for (int k = 0; k < count; ++k) {
      by.step(bench.system, of, {.dt = 0.3, .largest_error = 1e-12});  // rejected
      by.step(bench.system, of, {.dt = 0.1 + 0.01 * k});
    }
  };
  steps(*stepper, s, 7);
  copy = s;
  steps(*stepper, s, 5);
  steps(*make_rkc2(), copy, 5);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(s.now[i] == copy.now[i]);
  EXPECT_TRUE(s.past.empty());
}

TEST(Rkc2, RejectsAStepAboveTheLargestErrorAndLeavesTheState) {
  NodalBench bench(162);
  bench.react_with_waves();
  const auto stepper = make_rkc2();
  State s = bench.run(*stepper, 0.1, 2);
  const State before = s;
  const StepReport report = stepper->step(bench.system, s, {.dt = 0.5, .largest_error = 1e-9});
  EXPECT_FALSE(report.accepted);
  EXPECT_TRUE(report.failure.empty());
  EXPECT_GT(report.error, 1e-9);
  EXPECT_TRUE(s.now[0] == before.now[0] && s.now[1] == before.now[1]);
  EXPECT_EQ(s.step, before.step);
  EXPECT_EQ(s.time, before.time);
}

/// The estimate is of third order in the step.
TEST(Rkc2, EstimatesTheErrorOfAStep) {
  NodalBench bench(162);
  bench.react_with_waves();
  const auto error = [&](double dt) {
    State s = bench.state;
    return make_rkc2()->step(bench.system, s, {.dt = dt}).error;
  };
  EXPECT_NEAR(std::log2(error(0.4) / error(0.2)), 3, 0.6);
  EXPECT_GT(error(0.4), 1e-5);
}

TEST(Rkc2, ClampsHoldInEveryStage) {
  NodalBench bench(162);
  bench.add(0.01, [](const Point&) { return 0.05; });
  bench.system.species[0].lower = 0;
  bench.react([](const std::vector<double>&, double, std::vector<double>& rate) { rate[0] = -1; });
  const auto stepper = make_rkc2();
  State s = bench.state;
  const StepReport first = stepper->step(bench.system, s, {.dt = 0.1});
  EXPECT_TRUE(first.accepted);
  EXPECT_EQ(first.minimum, 0);
  EXPECT_EQ(first.error, 0);  // 0 is where it ends, however long the step
  const StepReport second = stepper->step(bench.system, s, {.dt = 0.1});
  EXPECT_EQ(second.error, 0);
  EXPECT_EQ(s.now[0].maxCoeff(), 0);
}

/// What is eaten up on one half and flows in from the other: at rest the border does not depend on the step.
TEST(Rkc2, TheBorderOfWhatAClampHoldsDoesNotDependOnTheStep) {
  const auto at_rest = [](double dt) {
    NodalBench bench(642, true);
    bench.add(0.2, [](const Point&) { return 1; });
    bench.system.species[0].lower = 0;
    std::vector<double> supply;
    for (const Point& x : bench.problem.control) supply.push_back(x[2] > 0 ? 1 : -1.5);
    bench.system.reaction.rates = [supply](const FieldPointers&, double, std::size_t begin, std::size_t end,
                                           const MutableFieldPointers& rate) {
      for (std::size_t k = begin; k < end; ++k) rate[0][k] = supply[k];
    };
    return bench.run(*make_rkc2(), 200, static_cast<int>(200 / dt)).now[0];
  };
  const Vector fine = at_rest(0.1), coarse = at_rest(5);
  EXPECT_GT((fine.array() == 0).count(), 50);
  EXPECT_LT((coarse - fine).cwiseAbs().maxCoeff(), 0.02 * fine.maxCoeff());
}

/// At rest the mass plays no part.
TEST(Rkc2, HeldNodesStayAndTheOthersFollow) {
  for (const bool half_consistent : {false, true}) {
    NodalBench bench(642, half_consistent);
    bench.add(0.5, [](const Point& x) { return x[2] > 0.8 ? 1 : 0; });
    Held held;
    for (const Point& x : bench.problem.control) held.push_back(x[2] > 0.8 || x[2] < -0.8);
    bench.system.held = std::make_shared<const Held>(held);
    const State s = bench.run(*make_rkc2(), 20, 200);
    for (std::size_t k = 0; k < held.size(); ++k)
      if (held[k]) {
        const auto at = static_cast<Eigen::Index>(k);
        EXPECT_EQ(s.now[0][at], bench.state.now[0][at]);
      }
    NodalBench lumped(642, false);
    lumped.system.held = bench.system.held;
    lumped.system.species = bench.system.species;
    lumped.state = bench.state;
    EXPECT_LT(relative(s.now[0], lumped.run(*make_stepper("sbdf2"), 20, 200).now[0]), 1e-4);
  }
}

TEST(Rkc2, SpeciesThatDoNotDiffuseAreLegal) {
  NodalBench bench(162);
  for (int k = 0; k < 3; ++k) bench.add(0, [](const Point& x) { return 1 + x[0]; });
  const State s = bench.run(*make_rkc2(), 1, 1);
  for (const Vector& u : s.now) EXPECT_TRUE(u == bench.state.now[0]);
}

TEST(Rkc2, BlowUpIsAnAnswerAndLeavesTheState) {
  for (const double start : {1e110, 1e14}) {
    NodalBench bench(162);
    bench.add(0.01, [&](const Point&) { return start; });
    bench.react([](const std::vector<double>& u, double, std::vector<double>& rate) { rate[0] = u[0] * u[0] * u[0]; });
    State s = bench.state;
    const StepReport report = make_rkc2()->step(bench.system, s, {.dt = 1});
    EXPECT_FALSE(report.accepted);
    EXPECT_FALSE(report.failure.empty());
    EXPECT_TRUE(s.now[0] == bench.state.now[0]);
  }
}

TEST(Rkc2, ASpeciesThatDecaysToNothingCostsNoSteps) {
  NodalBench bench(162);
  bench.add(0.01, [](const Point& x) { return 1 + 0.3 * x[0]; });
  bench.add(0.01, [](const Point&) { return 1; });
  bench.react([](const std::vector<double>& u, double, std::vector<double>& rate) {
    rate[0] = -u[0];
    rate[1] = 0;
  });
  const auto stepper = make_rkc2();
  State s = bench.state;
  for (int k = 0; k < 600; ++k) {
    const StepReport report = stepper->step(bench.system, s, {.dt = 0.2});
    ASSERT_TRUE(report.accepted) << k << report.failure;
    ASSERT_LE(report.error, 0.05) << k;
    ASSERT_LE(report.change, 1e3) << k;
  }
  EXPECT_EQ(s.now[0].cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(s.now[1].minCoeff(), 1);
}

/// A wave of 1e-6 of the field, du/dt = u - 1 + D lap u, grows as the theory says: at 1 - 2 D for the first harmonic.
TEST(Rkc2, FaintPatternsGrowAtTheirRate) {
  NodalBench bench(2562);
  bench.add(0.1, [](const Point& x) { return 1 + 1e-6 * x[2]; });
  bench.react([](const std::vector<double>& u, double, std::vector<double>& rate) { rate[0] = u[0] - 1; });
  const auto stepper = make_rkc2();
  State s = bench.state;
  StepReport report;
  for (int k = 0; k < 40; ++k) report = stepper->step(bench.system, s, {.dt = 0.05});
  const double growth = std::log((s.now[0].maxCoeff() - s.now[0].minCoeff()) / 2e-6) / 2;
  EXPECT_NEAR(growth, 0.8, 0.02);
  EXPECT_NEAR(report.change, 0.8, 0.03);
}

TEST(Rkc2, RefusesUnknownsThatAreNoValues) {
  const Problem problem = make_problem(builtin_shape("builtin:sphere?n=162"), make_loop, false);
  const SampledMass sampled = surface_space(problem.discretisation, problem.control, 2)->sampled(SampleRule::vertices);
  System system;
  system.mass = sampled.mass;
  system.sampling = sampled.sampling;
  State state;
  const StepReport report = make_rkc2()->step(system, state, {.dt = 1});
  EXPECT_FALSE(report.accepted);
  EXPECT_FALSE(report.failure.empty());
}

TEST(Rkc2, AmplifiesWavesAsExactSolutionsDoAndNoneThatDecays) {
  Linearisation l;
  l.jacobian = Eigen::MatrixXd{{0.3, -1.0}, {1.0, -0.5}};
  l.evolving = Eigen::VectorXd::Ones(2);
  const Eigen::MatrixXd decay = Eigen::MatrixXd{{0.2, 0}, {0, 2.0}};
  const auto defect = [&](double dt) {
    // The exponential by small steps of the same rule in the limit.
    Eigen::MatrixXd exact = Eigen::MatrixXd::Identity(2, 2);
    const Eigen::MatrixXd z = (l.jacobian - decay) * (dt / 1024);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2) + z + z * z / 2 + z * z * z / 6;
    for (int k = 0; k < 1024; ++k) exact = one * exact;
    return (rkc2.amplification(l, dt, decay) - exact).norm();
  };
  EXPECT_NEAR(std::log2(defect(0.02) / defect(0.01)), 3, 0.1);
  for (double scale = 1; scale < 1e3; scale *= 1.7)
    EXPECT_LT(rkc2.amplification(l, 1, scale * decay).norm(), 2) << scale;
}

}  // namespace
}  // namespace pelage
