// Models with gradients in their rates, from the file to the grown field.

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/bind.h"
#include "react/stability.h"
#include "run/run.h"
#include "shape/generators.h"
#include "support/sphere_run.h"
#include "support/steppers.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

Run finished(Run run) {
  run.advance(1000000);
  EXPECT_EQ(run.summary().status, RunStatus::time_reached) << run.summary().message;
  return run;
}

/// Root mean square of what the first species differs by from a function of the place.
double deviation(const Run& run, const std::function<double(const Point&)>& exact) {
  const Sampling& s = *run.system().sampling;
  const Vector u = s.values * run.coefficients()[0];
  double sum = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    sum += s.weight[i] * std::pow(u[i] - exact(s.position[static_cast<std::size_t>(i)]), 2);
  return std::sqrt(sum / s.weight.sum());
}

class Gradients : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Gradients, testing::Values("rkc2", "sbdf2", "semi-implicit", "explicit"),
                         [](const auto& name) { return stepper_test_name(name); });

/// On the unit sphere |grad z|^2 = 1 - z^2, grad x . grad z = -x z, lap z = -2 z and so div(z grad z) = 1 - 3 z^2: what
/// is left of the rate of u is nothing.
TEST_P(Gradients, AreThoseOfKnownFunctions) {
  const std::string known =
      "[species.v]\ndiffusion = 0\nrate = '0'\ninitial = 'x'\n"
      "[species.w]\ndiffusion = 0\nrate = '0'\ninitial = 'z'\n"
      "[species.shown]\nequals = 'sqrt(grad2(w))'\n";
  for (const std::string rate : {"grad2(w) - 1 + z^2", "dot(grad w, grad v) + x*z", "div(w grad w) - 1 + 3*z^2",
                                 "div(z grad w) - 1 + 3*z^2", "-2*div(w grad v) - 6*x*z"}) {
    const Growth run = finished(
        test::run_on_unit_sphere("[species.u]\ndiffusion = 0\nrate = '" + rate + "'\n" + known, GetParam(), 0.1, 1));
    EXPECT_LT(deviation(run, [](const Point&) { return 0.0; }), 0.02) << rate;
    EXPECT_NEAR(run.coefficients()[3].maxCoeff(), 1, 0.05);
  }
}

/// Cole 1951, Hopf 1950: with u = (2 nu / lambda) log w the equation of Kardar, Parisi and Zhang is w_t = nu lap w;
/// here nu = 1/2, lambda = 3 and w = 1 + 0.6 z exp(-2 nu t).
TEST_P(Gradients, GrowthAlongTheNormalIsTheHeatFlowOfColeAndHopf) {
  const Growth run = finished(test::run_on_unit_sphere(
      "[species.u]\ndiffusion = 0.5\nrate = '1.5*grad2(u)'\ninitial = 'log(1 + 0.6*z)/3'\n", GetParam(), 0.005, 0.4));
  const auto exact = [](const Point& p) { return std::log(1 + 0.6 * p[2] * std::exp(-0.4)) / 3; };
  EXPECT_LT(deviation(run, exact), 1e-3);
  EXPECT_GT(deviation(run, [](const Point& p) { return std::log(1 + 0.6 * p[2]) / 3; }), 0.04);
}

/// The same equation with steps of h, h/2 and h/4: their differences fall by 4, on whatever mesh.
TEST(GradientRuns, AreOfSecondOrderInTime) {
  for (const std::string stepper : {"rkc2", "sbdf2"}) {
    const auto end = [&](double step) {
      return finished(test::run_on_unit_sphere(
                          "[species.u]\ndiffusion = 0.5\nrate = '1.5*grad2(u)'\ninitial = 'log(1 + 0.6*z)/3'\n",
                          stepper, step, 0.4))
          .coefficients()[0];
    };
    const Vector coarse = end(0.05), middle = end(0.025), fine = end(0.0125);
    EXPECT_NEAR((coarse - middle).norm() / (middle - fine).norm(), 4, 0.8) << stepper;
  }
}

/// Deviations of c and n from 1/2 of the degree 2, k^2 = 6, against exp(A t) of the dispersion relation.
TEST_P(Gradients, ChemotaxisGrowsAsLinearTheorySays) {
  const double a = 1e-4, t = 0.5;
  const Growth run = finished(test::run_on_unit_sphere(
      "[species.n]\ndiffusion = 0.05\nrate = '-2*div(n*(1 - n) grad c)'\ninitial = '0.5 + 1e-4*(3*z^2 - 1)'\n"
      "[species.c]\ndiffusion = 1\nrate = 'n - c'\ninitial = '0.5'\n",
      GetParam(), 0.002, t));
  const double k2 = 6;
  Eigen::Matrix2d rate;  // of n and c
  rate << -0.05 * k2, 0.5 * k2, 1, -1 - k2;
  Eigen::Vector2d term(a, 0), sum = term;
  for (int k = 1; k < 40; ++k) sum += (term = rate * term * (t / k)).eval();
  const auto exact = [&](const Point& p) { return 0.5 + sum[0] * (3 * p[2] * p[2] - 1); };
  const double size = deviation(run, [](const Point&) { return 0.5; });
  EXPECT_LT(deviation(run, exact) / size, 0.01);
  const double half = rate.trace() / 2;
  EXPECT_NEAR(growth_rate(analyse_at(run.stage_program().model, {0.5, 0.5}), std::sqrt(k2)).real(),
              half + std::sqrt(half * half - rate.determinant()), 1e-12);
}

/// c varies in place only as far as the program knows.
TEST(Fluxes, WithAConstantCoefficientAreTheLaplacian) {
  const std::string v = "[species.v]\ndiffusion = 1\nrate = '-v'\ninitial = 'x*y + z'\n";
  const Growth run = test::run_on_unit_sphere("[species.u]\ndiffusion = 1\nrate = 'div(if(x < 9, 2, 3) grad v)'\n" + v,
                                              "sbdf2", 0.1, 1);
  const Vector flux = run.system().fluxes(run.initial(), 0)[0];
  const Vector lap = *run.space().stiffness() * run.initial()[1] * -2;
  EXPECT_LT((flux - lap).cwiseAbs().maxCoeff(), 1e-13 * lap.cwiseAbs().maxCoeff());
  EXPECT_NEAR(flux.sum(), 0, 1e-13 * flux.cwiseAbs().sum());
}

Run of_model(const std::string& model, const std::string& stepper, const std::string& method) {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  recipe.stages[0].stepper.value = stepper;
  recipe.stages[0].method.value = method;
  recipe.stages[0].size = Given<Length>{{1, Length::Unit::world}, {}};
  recipe.stages[0].interpolate = true;
  return Run(make_program(recipe, builtin_shape("builtin:sphere?n=642")));
}

TEST(Fluxes, MoveNoAmount) {
  for (const auto& [stepper, bound] : {std::pair{"sbdf2", 1e-10}, std::pair{"rkc2", 1e-6}}) {
    Growth run = of_model("keller-segel", stepper, stepper == std::string("sbdf2") ? "loop" : "remeshed");
    const double before = run.amounts()[1];
    run.advance(1000000);
    EXPECT_EQ(run.summary().status == RunStatus::failed, false) << run.summary().message;
    EXPECT_GT(run.coefficients()[1].maxCoeff() - run.coefficients()[1].minCoeff(), 0.3);
    EXPECT_NEAR(run.amounts()[1] / before, 1, bound) << stepper;
  }
}

TEST(GradientRuns, TwoSlicesAreOneSliceBitForBit) {
  for (const std::string model : {"keller-segel", "kpz", "kuramoto-sivashinsky"})
    for (const std::string stepper : {"sbdf2", "rkc2"}) {
      if (stepper == "rkc2" && model == "kuramoto-sivashinsky") continue;
      const auto start = [&] { return of_model(model, stepper, stepper == "rkc2" ? "remeshed" : "loop"); };
      Growth whole = start(), sliced = start(), resumed = start();
      whole.advance(20);
      sliced.advance(7);
      resumed.restore(sliced.checkpoint());
      resumed.advance(13);
      EXPECT_TRUE(whole.checkpoint() == resumed.checkpoint()) << model << " " << stepper;
    }
}

}  // namespace
}  // namespace pelage
