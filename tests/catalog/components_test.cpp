// What CONTRIBUTING says of new methods and steppers: a descriptor each, and recipes can name them. Nothing else is
// touched.

#include "catalog/components.h"

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "discretise/surface_space.h"
#include "look/dress.h"
#include "run/run.h"
#include "shape/generators.h"
#include "time/step_support.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

/// Loop elements with a quadrature that is twice as fine.
std::shared_ptr<const Space> fine_space(std::shared_ptr<const Topology> topology, std::vector<Point> control) {
  return surface_space(loop_discretisation(std::move(topology), {.regular_splits = 1, .irregular_splits = 2}),
                       std::move(control), 2);
}

Method fine_loop() {
  Method method = loop_method;
  method.name = "fine-loop";
  method.make_space = fine_space;
  return method;
}

/// Explicit midpoint rule on a mass matrix that is solved for exactly.
class Midpoint final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override {
    StepReport report;
    const std::vector<Vector> half = advanced(system, state.now, state.now, state.time, request.dt / 2);
    std::vector<Vector> next = advanced(system, state.now, half, state.time + request.dt / 2, request.dt);
    advance(system, state, request.dt, next, report);
    return report;
  }

 private:
  static std::vector<Vector> advanced(const System& system, const std::vector<Vector>& from,
                                      const std::vector<Vector>& at, double t, double dt) {
    std::vector<Vector> samples, rates, result;
    sample_fields(system, at, samples);
    evaluate_rates(system, samples, t, rates);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Species& s = system.species[i];
      const Vector flux = load(*system.sampling, rates[i]) - s.diffusion * (*s.stiffness * at[i]);
      result.push_back(from[i] + dt * solve_spd(*system.mass, flux, {.tolerance = 1e-12}));
    }
    return result;
  }
};

Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(decay.rows(), decay.rows()), a = dt * (l.jacobian - decay);
  return one + a + a * a / 2;
}

const StepperKind midpoint = {.name = "midpoint",
                              .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<Midpoint>(); },
                              .amplification = amplification};

Recipe small_recipe(const std::string& method, const std::string& stepper) {
  Recipe recipe;
  recipe.stages[0].method.value = method;
  recipe.stages[0].stepper.value = stepper;
  recipe.stages[0].size = {{0.5}, {}};
  recipe.stages[0].steps = 200;
  return recipe;
}

Vector grown(const Recipe& recipe, const Components& components) {
  Growth run(bind_plan(plan(recipe, components), builtin_shape("builtin:sphere?n=162")));
  run.advance(1000);
  EXPECT_EQ(run.summary().status, RunStatus::steps_reached) << run.summary().message;
  EXPECT_EQ(dress(run.fields(), recipe.look).find("color")->values.size() % 3, 0U);
  return run.coefficients()[1];
}

TEST(Components, AMethodAndAStepperOfOnesOwnGrowACoat) {
  const Method fine = fine_loop();
  Components components;
  components.methods.push_back(&fine);
  components.steppers.push_back(&midpoint);
  Recipe recipe = small_recipe("fine-loop", "midpoint");
  recipe.stages[0].step = 0.05;
  const Vector own = grown(recipe, components);
  recipe.stages[0].stepper.value = "explicit";
  const Vector known = grown(recipe, components);
  EXPECT_GT((own - known).norm(), 0);
  EXPECT_LT((own - known).norm(), 0.05 * (known.array() - known.mean()).matrix().norm());
  recipe.stages[0].step.reset();  // the largest that its amplification allows
  recipe.stages[0].stepper.value = "midpoint";
  grown(recipe, components);
}

TEST(Components, OthersAreUnknown) {
  try {
    plan(small_recipe("loop", "midpoint"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("known: rkc2, sbdf2, semi-implicit, explicit"), std::string::npos)
        << error.what();
  }
}

TEST(Components, OlderNamesStay) { EXPECT_EQ(plan(small_recipe("loop", "paper")).stages[0].stepper, &semi_implicit); }

}  // namespace
}  // namespace pelage
