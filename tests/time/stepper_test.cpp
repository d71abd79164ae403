#include "time/stepper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discretise/surface_space.h"
#include "shape/generators.h"
#include "support/split_reaction.h"
#include "support/steppers.h"
#include "verify/problem.h"

namespace pelage {
namespace {

/// One species or more on a small sphere, with a reaction given sample by sample.
struct Bench {
  explicit Bench(const std::string& stepper, const std::string& spec = "builtin:sphere?n=162")
      : problem(make_problem(builtin_shape(spec), make_loop, false)), assembler(problem.discretisation) {
    const SampledMass sampled =
        surface_space(problem.discretisation, problem.control, 2)->sampled(stepper_named(stepper).samples);
    system.mass = sampled.mass;
    system.sampling = sampled.sampling;
    system.weighted_mass = [this](const Vector& f) {
      return assembler.mass(problem.control, std::vector<double>(f.begin(), f.end()));
    };
    set_reaction([](const std::vector<double>&, std::vector<double>&, std::vector<double>&) {});
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void add_species(const std::string& name, double diffusion, double start) {
    Species& s = system.species.emplace_back();
    s.name = name;
    s.diffusion = diffusion;
    s.stiffness = std::make_shared<const SparseMatrix>(problem.stiffness);
    state.now.push_back(Vector::Constant(problem.discretisation.unknowns, start));
  }

  /// c2 and c3 of all species from the values of all species; R = c2 u + c3.
  template <class Split>
  void set_reaction(Split split) {
    pelage::set_reaction(system, [split](const std::vector<double>& u, double, std::vector<double>& c2,
                                         std::vector<double>& c3) { split(u, c2, c3); });
  }

  Problem problem;
  Assembler assembler;
  System system;
  State state;
};

/// a x + b y over the points: something that is not constant.
Vector tilted(const std::vector<Point>& control) {
  Vector u(static_cast<Eigen::Index>(control.size()));
  for (std::size_t i = 0; i < control.size(); ++i)
    u[static_cast<Eigen::Index>(i)] = 1 + 0.3 * control[i][0] - 0.2 * control[i][1] * control[i][2];
  return u;
}

constexpr double speed = 0.05;  // s of the Turing system

void turing(const std::vector<double>& u, std::vector<double>& c2, std::vector<double>& c3) {
  c2 = {-speed * u[1], speed * (u[0] - 1)};
  c3 = {speed * 16, -speed * 12};
}

/// Deviation from the steady state (4, 4) after 2000 steps of s dt = `relative_step`, from a deviation of 1e-6.
double final_deviation(const std::string& name, double relative_step) {
  Bench setup(name, "builtin:sphere?n=100");
  setup.add_species("a", 0, 4 + 1e-6);
  setup.add_species("b", 0, 4);
  setup.set_reaction(turing);
  const auto stepper = make_stepper(name);
  for (int k = 0; k < 2000; ++k) {
    const StepReport report =
        stepper->step(setup.system, setup.state, {.dt = relative_step / speed, .solver_tolerance = 1e-14});
    if (!report.accepted) return std::numeric_limits<double>::infinity();
  }
  return std::hypot(setup.state.now[0][0] - 4, setup.state.now[1][0] - 4);
}

/// The paper's scheme on the uniform state: u^(n+1) = (1 - dt C2(u^n))^-1 (u^n + dt C3(u^n)) with both species taken at
/// step n has an eigenvalue beyond the unit circle for s dt > 1/28.
TEST(PaperStepper, IsStableUpToOneTwentyEighthOfTheReactionTime) {
  EXPECT_LT(final_deviation("semi-implicit", 0.9 / 28), 0.5e-6);
  EXPECT_GT(final_deviation("semi-implicit", 1.1 / 28), 2e-6);
}

TEST(Sbdf2, IsStableAtFiveTimesThat) { EXPECT_LT(final_deviation("sbdf2", 0.15), 1e-8); }

class EveryStepper : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Steppers, EveryStepper, ::testing::ValuesIn(stepper_names()),
                         [](const auto& name) { return stepper_test_name(name); });

TEST_P(EveryStepper, PureDiffusionKeepsTheIntegralAndSmooths) {
  Bench setup(GetParam());
  setup.add_species("u", 0.1, 0);
  setup.state.now[0] = tilted(setup.problem.control);
  const Vector ones = Vector::Ones(setup.problem.discretisation.unknowns);
  auto integral = [&] { return dot(ones, *setup.system.mass * setup.state.now[0]); };
  auto range = [&] { return setup.state.now[0].maxCoeff() - setup.state.now[0].minCoeff(); };
  const double before = integral(), range_before = range();
  const auto stepper = make_stepper(GetParam());
  for (int k = 0; k < 200; ++k) stepper->step(setup.system, setup.state, {.dt = 0.01, .solver_tolerance = 1e-13});
  EXPECT_NEAR(integral() / before, 1, 1e-10);
  EXPECT_LT(range(), 0.75 * range_before);  // exp(-2 D t) = 0.67 for the slowest mode
  EXPECT_NEAR(setup.state.time, 2, 1e-12);
  EXPECT_EQ(setup.state.step, 200);
}

/// du/dt = -u + 2 on a uniform field: 2 - exp(-t).
TEST_P(EveryStepper, UniformFieldFollowsItsEquation) {
  Bench setup(GetParam());
  setup.add_species("u", 0.3, 1);
  setup.set_reaction([](const std::vector<double>&, std::vector<double>& c2, std::vector<double>& c3) {
    c2 = {-1};
    c3 = {2};
  });
  const auto stepper = make_stepper(GetParam());
  for (int k = 0; k < 100; ++k) stepper->step(setup.system, setup.state, {.dt = 0.01, .solver_tolerance = 1e-13});
  const Vector& u = setup.state.now[0];
  EXPECT_NEAR(u.mean(), 2 - std::exp(-1), 3e-3);
  EXPECT_LT(u.maxCoeff() - u.minCoeff(), 1e-9);
}

TEST_P(EveryStepper, SpeciesThatDoNotDiffuseAreLegal) {
  Bench setup(GetParam());
  setup.add_species("u", 0, 0);
  setup.state.now[0] = tilted(setup.problem.control);
  const Vector before = setup.state.now[0];
  const StepReport report =
      make_stepper(GetParam())->step(setup.system, setup.state, {.dt = 1, .solver_tolerance = 1e-13});
  EXPECT_TRUE(report.accepted);
  EXPECT_LT((setup.state.now[0] - before).cwiseAbs().maxCoeff(), 1e-10);
}

TEST_P(EveryStepper, ClampsHoldTheCoefficients) {
  for (const double rate : {-1.0, 1.0}) {
    Bench setup(GetParam());
    setup.add_species("u", 0.01, 0.05);
    setup.system.species[0].lower = 0;
    setup.system.species[0].upper = 0.125;
    setup.set_reaction([rate](const std::vector<double>&, std::vector<double>& c2, std::vector<double>& c3) {
      c2 = {0};
      c3 = {rate};
    });
    const auto stepper = make_stepper(GetParam());
    for (int k = 0; k < 3; ++k) {
      const StepReport report = stepper->step(setup.system, setup.state, {.dt = 0.1});
      EXPECT_TRUE(report.accepted);
    }
    EXPECT_EQ(setup.state.now[0].minCoeff(), rate < 0 ? 0 : 0.125);
    EXPECT_EQ(setup.state.now[0].maxCoeff(), rate < 0 ? 0 : 0.125);
  }
}

/// du/dt = u^3 from 1e100 leaves the range of doubles at once: the report says so and the state stays as it was.
TEST_P(EveryStepper, BlowUpIsAnAnswerAndLeavesTheState) {
  Bench setup(GetParam());
  setup.add_species("u", 0.01, 1e110);
  setup.set_reaction([](const std::vector<double>& u, std::vector<double>& c2, std::vector<double>& c3) {
    c2 = {0};
    c3 = {u[0] * u[0] * u[0]};
  });
  const State before = setup.state;
  const StepReport report = make_stepper(GetParam())->step(setup.system, setup.state, {.dt = 1});
  EXPECT_FALSE(report.accepted);
  EXPECT_FALSE(report.failure.empty());
  EXPECT_EQ(setup.state.now[0], before.now[0]);
  EXPECT_EQ(setup.state.time, before.time);
  EXPECT_EQ(setup.state.step, before.step);
  EXPECT_EQ(setup.state.past.size(), before.past.size());
}

TEST(Sbdf2, RejectsAStepAboveTheLargestErrorAndLeavesTheState) {
  Bench setup("sbdf2");
  setup.add_species("u", 0.01, 1);
  setup.set_reaction([](const std::vector<double>& u, std::vector<double>& c2, std::vector<double>& c3) {
    c2 = {-5 * u[0] * u[0]};
    c3 = {0};
  });
  const auto stepper = make_stepper("sbdf2");
  for (int k = 0; k < 3; ++k) stepper->step(setup.system, setup.state, {.dt = 0.01});
  const Vector before = setup.state.now[0];
  const StepReport report = stepper->step(setup.system, setup.state, {.dt = 0.3, .largest_error = 1e-9});
  EXPECT_FALSE(report.accepted);
  EXPECT_TRUE(report.failure.empty());
  EXPECT_GT(report.error, 1e-9);
  EXPECT_EQ(setup.state.now[0], before);
}

/// Steps of changing size keep the second order: the error falls four times when all are halved.
TEST(Sbdf2, KeepsItsOrderWhenStepsVary) {
  auto error = [](int parts) {
    Bench setup("sbdf2");
    setup.add_species("u", 0.1, 1);
    setup.set_reaction([](const std::vector<double>& u, std::vector<double>& c2, std::vector<double>& c3) {
      c2 = {-u[0]};
      c3 = {0};
    });
    const auto stepper = make_stepper("sbdf2");
    for (int k = 0; k < 16; ++k)
      for (int part = 0; part < parts; ++part)
        stepper->step(setup.system, setup.state,
                      {.dt = (k % 3 == 0   ? 0.02
                              : k % 3 == 1 ? 0.03
                                           : 0.045) /
                             parts,
                       .solver_tolerance = 1e-13});
    return std::abs(setup.state.now[0].mean() - 1 / (1 + setup.state.time));  // of du/dt = -u^2
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 2, 0.15);
}

/// du/dt = -u: exp(-400) is far below what can be squared.
TEST_P(EveryStepper, ASpeciesThatDecaysToNothingCostsNoSteps) {
  Bench setup(GetParam(), "builtin:sphere?n=162");
  setup.add_species("u", 0.01, 0);
  setup.add_species("v", 0.01, 1);
  setup.state.now[0] = tilted(setup.problem.control);
  setup.set_reaction([](const std::vector<double>&, std::vector<double>& c2, std::vector<double>& c3) {
    c2 = {-1, 0};
    c3 = {0, 0};
  });
  const auto stepper = make_stepper(GetParam());
  for (int k = 0; k < 2000; ++k) {
    const StepReport report = stepper->step(setup.system, setup.state, {.dt = 0.2, .solver_tolerance = 1e-6});
    ASSERT_TRUE(report.accepted) << k << report.failure;
    ASSERT_LE(report.error, 0.05) << k;
    ASSERT_LE(report.change, 1e3) << k;
  }
  EXPECT_EQ(setup.state.now[0].cwiseAbs().maxCoeff(), 0);
  EXPECT_NEAR(setup.state.now[1].minCoeff(), 1, 1e-4);
}

}  // namespace
}  // namespace pelage
