// Models with Laplacians in their rates, from the file to the grown field.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "catalog/bind.h"
#include "pelage/error.h"
#include "react/stability.h"
#include "run/run.h"
#include "shape/generators.h"
#include "support/steppers.h"
#include "time/step_support.h"

namespace pelage {
namespace {

Program on_sphere(const std::string& model, const std::string& stepper = "sbdf2", const std::string& method = "loop") {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  recipe.stages[0].stepper.value = stepper;
  recipe.stages[0].method.value = method;
  recipe.stages[0].size = Given<Length>{{2, Length::Unit::world}, {}};
  recipe.stages[0].interpolate = true;
  return make_program(recipe, builtin_shape("builtin:sphere?n=642"));
}

/// The spherical harmonic 3 z^2 - 1 as coefficients.
Vector harmonic(const System& system) {
  const Sampling& sampling = *system.sampling;
  Vector samples(sampling.count());
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const double z = sampling.position[static_cast<std::size_t>(i)][2];
    samples[i] = 3 * z * z - 1;
  }
  return coefficients_from_samples(sampling, *system.mass, samples);
}

/// A single mode of degree 2 grows as the dispersion relation says, k^2 = 6 on the unit sphere: as exp(sigma t), which
/// turns from u (species 0) to v (species 1) where sigma is complex.
void expect_growth_of_theory(const std::string& model, std::size_t shown, const std::string& method, double error) {
  const Run run(on_sphere(model, "sbdf2", method));
  const System& system = run.system();
  const double amplitude = 1e-5, dt = 0.01;
  const int steps = 150;
  const Vector mode = harmonic(system);
  State state;
  state.now = run.initial();
  const Stability theory = analyse(run.stage_program().model);
  for (std::size_t i = 0; i < state.now.size(); ++i) state.now[i].setConstant(theory.steady_states[theory.chosen][i]);
  const std::vector<Vector> uniform_state = state.now;
  state.now[shown] += amplitude * mode;
  ASSERT_TRUE(solve_algebraic(system, 0, state.now, 1e-13).converged);
  const auto stepper = make_stepper("sbdf2");
  for (int k = 0; k < steps; ++k)
    ASSERT_TRUE(stepper->step(system, state, {.dt = dt, .solver_tolerance = 1e-13}).accepted);
  const auto share = [&](std::size_t i) {
    const Vector weighted = *system.mass * mode;
    return dot(weighted, state.now[i] - uniform_state[i]) / (amplitude * dot(weighted, mode));
  };
  const std::complex<double> sigma = growth_rate(theory, std::sqrt(6.0) * run.stage_program().length_unit);
  const std::complex<double> factor = std::exp(sigma * (steps * dt));
  EXPECT_GT(std::abs(sigma) * steps * dt, 0.03);  // more than ten times the error that is allowed
  EXPECT_NEAR(share(shown) / factor.real(), 1, error) << sigma;
  if (sigma.imag() != 0) {
    EXPECT_NEAR(std::abs(share(1 - shown) / factor.imag()), 1, error) << sigma;
  }
}

Run start(const std::string& model) { return Run(on_sphere(model)); }

void expect_growth_of_theory(const std::string& model, std::size_t shown) {
  expect_growth_of_theory(model, shown, "loop", 3e-3);
  expect_growth_of_theory(model, shown, "remeshed", 5e-3);
}

TEST(CoupledGrowth, SwiftHohenberg) { expect_growth_of_theory("swift-hohenberg", 1); }
TEST(CoupledGrowth, KuramotoSivashinsky) { expect_growth_of_theory("kuramoto-sivashinsky", 1); }
TEST(CoupledGrowth, CahnHilliard) { expect_growth_of_theory("cahn-hilliard:droplets", 1); }
TEST(CoupledGrowth, OhtaKawasaki) { expect_growth_of_theory("ohta-kawasaki:dots", 1); }
TEST(CoupledGrowth, ComplexGinzburgLandau) { expect_growth_of_theory("complex-ginzburg-landau:turbulent", 0); }

TEST(CoupledGrowth, CahnHilliardKeepsItsMeanOverAWholeRun) {
  auto run = start("cahn-hilliard:droplets");
  const SparseMatrix& mass = *run.system().mass;
  const double before = (mass * run.coefficients()[1]).sum();
  run.advance(1000);
  EXPECT_GT(run.summary().time, 50);
  EXPECT_GT(run.coefficients()[1].maxCoeff() - run.coefficients()[1].minCoeff(), 1);
  EXPECT_NEAR((mass * run.coefficients()[1]).sum() / before, 1, 1e-10);
}

TEST(CoupledGrowth, TwoSlicesAreOneSliceBitForBit) {
  for (const char* model : {"swift-hohenberg", "complex-ginzburg-landau"}) {
    auto whole = start(model), sliced = start(model), resumed = start(model);
    whole.advance(30);
    sliced.advance(11);
    resumed.restore(sliced.checkpoint());
    resumed.advance(19);
    EXPECT_TRUE(whole.checkpoint() == resumed.checkpoint()) << model;
  }
}

TEST(CoupledGrowth, SemiImplicitEulerIsRefusedBeforeAnyWork) {
  try {
    on_sphere("swift-hohenberg", "semi-implicit");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_STREQ(
        error.what(),
        "the stepper \"semi-implicit\" cannot grow \"swift-hohenberg\", whose species are coupled by lap(); take "
        "\"sbdf2\"");
  }
}

}  // namespace
}  // namespace pelage
