// Threshold patterns on surfaces by rounds of implicit solves.

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "run/run.h"

namespace pelage {
namespace {

/// b M u_i + K_i u_i = M k [p > q], with b = k = 1: the equations of the model, written down a second time.
TEST(SteadyGrowth, ThresholdsComeToRestWhereTheEquationsDo) {
  const Recipe recipe = parse_recipe(
      "[stage]\nmodel = \"witkin-kass-stripes\"\nsize = \"0.5u\"\nstepper = \"sign-iteration\"\n", "r.toml");
  pelage::Run run(make_program(recipe, load_shape("builtin:sphere?n=642")));
  while (!run.done()) run.advance(1);
  EXPECT_EQ(run.summary().status, RunStatus::stationary);
  EXPECT_FALSE(run.uniform());
  const System& system = run.system();
  const Vector &q = run.coefficients()[0], &p = run.coefficients()[1];
  const Vector on = (p.array() > q.array()).cast<double>().matrix();
  EXPECT_NEAR(on.mean(), 0.5, 0.1);
  for (std::size_t i : {0, 1}) {
    const Vector& u = run.coefficients()[i];
    const Species& s = system.species[i];
    const Vector made = *system.mass * on, residual = *system.mass * u + s.diffusion * Vector(*s.stiffness * u) - made;
    EXPECT_LT(residual.norm(), 1e-5 * made.norm());
  }
}

}  // namespace
}  // namespace pelage
