#include "run/stage_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/bind.h"
#include "run/run.h"
#include "shape/generators.h"
#include "support/sphere_run.h"
#include "support/steppers.h"
#include "time/stepper.h"

namespace pelage {
namespace {

/// Of a species u that starts as z.
Run on_unit_sphere(const std::string& equation, const std::string& stepper, double step) {
  return test::run_on_unit_sphere("[species.u]\ninitial = 'z'\n" + equation, stepper, step, 1);
}

/// The factor by which u has shrunk, if it is still a multiple of z to within a percent.
double decay(Run run) {
  run.advance(1000000);
  EXPECT_EQ(run.summary().status, RunStatus::time_reached) << run.summary().message;
  const Sampling& s = *run.system().sampling;
  const Vector u = s.values * run.coefficients()[0];
  double uz = 0, zz = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double z = s.position[static_cast<std::size_t>(i)][2];
    uz += u[i] * z;
    zz += z * z;
  }
  for (Eigen::Index i = 0; i < u.size(); ++i)
    EXPECT_NEAR(u[i], uz / zz * s.position[static_cast<std::size_t>(i)][2], 0.02);
  return uz / zz;
}

class EveryStepperWithCoefficients : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Steppers, EveryStepperWithCoefficients,
                         ::testing::Values("rkc2", "sbdf2", "semi-implicit", "explicit"),
                         [](const auto& name) { return stepper_test_name(name); });

TEST_P(EveryStepperWithCoefficients, TakesAPrefactorThatVariesAndVanishes) {
  // lap z = -2 z on the unit sphere: with R = 2 C0 u - u/2 the solution is z exp(-t/2), whatever C0 is.
  const std::string equation = "C0 = '0.05*max(0, z + x)'\nC1 = '1'\nrate = '0.1*max(0, z + x)*u - 0.5*u'";
  EXPECT_NEAR(decay(on_unit_sphere(equation, GetParam(), 0.02)), std::exp(-0.5), 0.01);
}

TEST_P(EveryStepperWithCoefficients, FollowsADiffusionThatChangesInTime) {
  // u = z exp(-2 integral of D): D = t/4 gives exp(-1/4) at t = 1.
  const std::string equation = "diffusion = '0.25*t'\nrate = '0'";
  EXPECT_NEAR(decay(on_unit_sphere(equation, GetParam(), 0.01)), std::exp(-0.25), 0.01);
}

TEST_P(EveryStepperWithCoefficients, FollowsADiffusionThatDependsOnTheField) {
  // The same everywhere and always, although it is written with the field.
  const std::string equation = "diffusion = '0.1 + min(abs(u), 0)'\nrate = '0'";
  EXPECT_NEAR(decay(on_unit_sphere(equation, GetParam(), 0.02)), std::exp(-0.2), 0.01);
}

TEST(Operators, RefuseNegativeCoefficients) {
  EXPECT_THROW(on_unit_sphere("C0 = 'z'\nC1 = '1'\nrate = '0'", "sbdf2", 0.1), Error);
  EXPECT_THROW(on_unit_sphere("diffusion = 'z'\nrate = '0'", "sbdf2", 0.1), Error);
}

}  // namespace
}  // namespace pelage
