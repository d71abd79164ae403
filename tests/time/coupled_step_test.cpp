// Coupled species: fourth-order and cross-diffusion terms.

#include <gtest/gtest.h>

#include <cmath>

#include "discretise/surface_space.h"
#include "shape/generators.h"
#include "support/steppers.h"
#include "time/step_support.h"
#include "verify/problem.h"

namespace pelage {
namespace {

using Rates = std::function<std::vector<double>(const std::vector<double>&)>;

/// Two coupled species on a small sphere.
struct Pair {
  Pair(const Eigen::Matrix2d& diffusion, bool first_is_algebraic, Rates rates)
      : problem(make_problem(builtin_shape("builtin:sphere?n=162"), make_loop, false)) {
    const SampledMass sampled =
        surface_space(problem.discretisation, problem.control, 2)->sampled(SampleRule::vertices);
    system.mass = sampled.mass;
    system.sampling = sampled.sampling;
    const auto stiffness = std::make_shared<const SparseMatrix>(problem.stiffness);
    for (const char* name : {"first", "second"}) {
      Species& s = system.species.emplace_back();
      s.name = name;
      s.stiffness = stiffness;
      s.coupled = true;
    }
    system.species[0].algebraic = first_is_algebraic;
    system.coupled = {{0, 1}, diffusion, stiffness};
    system.reaction.rates = [rates](const FieldPointers& u, double, std::size_t begin, std::size_t end,
                                    const MutableFieldPointers& out) {
      for (std::size_t s = begin; s < end; ++s) {
        const std::vector<double> rate = rates({u[0][s], u[1][s]});
        for (std::size_t i = 0; i < 2; ++i) out[i][s] = rate[i];
      }
    };
    state.now = {wave(0, 1), wave(2, 3)};
    solve_algebraic(system, 0, state.now, 1e-14);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  Vector wave(std::size_t d, double phase) const {
    Vector u(problem.discretisation.unknowns);
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const Point& p = problem.control[static_cast<std::size_t>(i)];
      u[i] = 0.2 * std::sin(2 * p[d % 3] + phase) + 0.1 * p[1] * p[2];
    }
    return u;
  }
  StepReport run(const std::string& name, double until, int steps) {
    const auto stepper = make_stepper(name);
    StepReport report;
    for (int k = 0; k < steps; ++k)
      report = stepper->step(system, state, {.dt = until / steps, .solver_tolerance = 1e-13});
    return report;
  }
  double integral(std::size_t i) const { return (*system.mass * state.now[i]).sum(); }

  Problem problem;
  System system;
  State state;
};

Pair swift_hohenberg() {  // w = lap(u); u' = -0.7 u - 2 w - lap(w) + u^2 - u^3, at a third of the length
  return Pair(Eigen::Matrix2d{{0, 1.0 / 9}, {-1.0 / 9, 0}}, true, [](const std::vector<double>& u) {
    return std::vector<double>{0, -0.7 * u[1] - 2 * u[0] + u[1] * u[1] - u[1] * u[1] * u[1]};
  });
}

Pair cahn_hilliard() {
  return Pair(Eigen::Matrix2d{{0, -0.04}, {1, 2}}, true, [](const std::vector<double>& u) {
    return std::vector<double>{u[1] * u[1] * u[1] - 3 * u[1], 0};
  });
}

Pair ginzburg_landau() {
  return Pair(Eigen::Matrix2d{{0.1, -0.2}, {0.2, 0.1}}, false, [](const std::vector<double>& u) {
    const double square = u[0] * u[0] + u[1] * u[1];
    return std::vector<double>{u[0] - square * (u[0] + 0.5 * u[1]), u[1] - square * (u[1] - 0.5 * u[0])};
  });
}

class EveryPair : public testing::TestWithParam<Pair (*)()> {};
INSTANTIATE_TEST_SUITE_P(Coupled, EveryPair, testing::Values(&swift_hohenberg, &cahn_hilliard, &ginzburg_landau));

TEST_P(EveryPair, BackwardDifferencesAreOfSecondOrder) {
  const auto result = [&](int steps) {
    Pair pair = GetParam()();
    pair.run("sbdf2", 0.5, steps);
    return pair.state.now;
  };
  const auto fine = result(640);
  const auto error = [&](int steps, std::size_t i) { return (result(steps)[i] - fine[i]).norm(); };
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(error(40, i) / error(80, i)), 2, 0.25);
}

/// The explicit scheme takes no part of the coupled solve but the algebraic one.
TEST_P(EveryPair, ExplicitAndImplicitStepsAgree) {
  Pair a = GetParam()(), b = GetParam()();
  a.run("sbdf2", 0.02, 100);
  b.run("explicit", 0.02, 2000);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((a.state.now[i] - b.state.now[i]).norm(), 3e-4 * a.state.now[i].norm()) << i;
}

/// M u^(n+1) + dt sum_j D_ij K u_j^(n+1) = M u^n + dt load(R^n), or without M u^n and dt: the first step.
TEST_P(EveryPair, TheFirstStepSolvesItsEquations) {
  Pair pair = GetParam()();
  const std::vector<Vector> before = pair.state.now;
  std::vector<Vector> samples, rates;
  sample_fields(pair.system, before, samples);
  evaluate_rates(pair.system, samples, 0, rates);
  const double dt = 0.1;
  pair.run("sbdf2", dt, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    const bool algebraic = pair.system.species[i].algebraic;
    const double factor = algebraic ? 1 : dt;
    Vector rest = *pair.system.mass * pair.state.now[i] - factor * load(*pair.system.sampling, rates[i]);
    if (!algebraic) rest -= *pair.system.mass * before[i];
    for (std::size_t j = 0; j < 2; ++j)
      rest += factor * pair.system.coupled.diffusion(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
              (pair.problem.stiffness * pair.state.now[j]);
    EXPECT_LT(rest.norm(), 1e-11 * (*pair.system.mass * pair.state.now[i]).norm()) << i;
  }
}

/// Whatever the tolerance of the solves is.
TEST(CoupledStep, CahnHilliardKeepsTheAmountOfEachPhase) {
  for (const char* name : {"sbdf2", "explicit"}) {
    Pair pair = cahn_hilliard();
    pair.state.now[1].array() += 0.3;
    const double before = pair.integral(1), dt = std::string(name) == "sbdf2" ? 0.2 : 1e-5;
    const auto stepper = make_stepper(name);
    const double tolerance = std::string(name) == "sbdf2" ? 1e-4 : 1e-12;
    for (int k = 0; k < 200; ++k)
      ASSERT_TRUE(stepper->step(pair.system, pair.state, {.dt = dt, .solver_tolerance = tolerance}).accepted);
    EXPECT_NEAR(pair.integral(1) / before, 1, 1e-10) << name;
  }
}

TEST(CoupledStep, AStepThatIsTooLargeIsAnAnswer) {
  // u' = -2 lap(u) - lap(w) with w = lap(u): indefinite for dt > 1 / 1, the first step being Euler's.
  Pair pair(Eigen::Matrix2d{{0, 1}, {-1, -2}}, true, [](const std::vector<double>&) {
    return std::vector<double>{0, 0};
  });
  const Vector before = pair.state.now[1];
  const StepReport report = pair.run("sbdf2", 4, 1);
  EXPECT_FALSE(report.accepted);
  EXPECT_NE(report.failure.find("the matrix of first and second is not positive definite"), std::string::npos)
      << report.failure;
  EXPECT_EQ(pair.state.now[1], before);
}

TEST(CoupledStep, SemiImplicitEulerDeclines) {
  Pair pair = ginzburg_landau();
  EXPECT_FALSE(pair.run("semi-implicit", 0.1, 1).failure.empty());
}

}  // namespace
}  // namespace pelage
