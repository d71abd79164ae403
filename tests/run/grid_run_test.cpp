// Runs on the elements of grids (discretise/grid_space.h).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "catalog/plan.h"
#include "pelage/error.h"
#include "run/run.h"
#include "support/model_stage.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

/// n x n nodes of a periodic tile of side 1, even or bent within itself.
Grid tile(std::int32_t n, bool bent) {
  Grid g;
  g.count = {n, n, 1};
  g.periodic = {true, true, false};
  g.spacing = {1.0 / n, 1.0 / n, 1};
  if (!bent) return g;
  std::vector<Point> points;
  for (std::int32_t v = 0; v < n * n; ++v) {
    Point p = g.point(v);
    p[0] += 0.02 * std::sin(2 * std::numbers::pi * (p[0] + p[1]));
    points.push_back(p);
  }
  g.points = std::move(points);
  g.period = {{{1, 0, 0}, {0, 1, 0}, {}}};
  return g;
}

Growth grow_on(const Grid& grid, const std::string& model, const StepperKind& stepper, double size,
               const Method& method = grid_method) {
  Program program;
  program.method = &method;
  program.stages.push_back(stage_of(model, stepper, size));
  return Growth(std::make_shared<const Program>(std::move(program)), World(method.make_node_space(grid)));
}

TEST(GridRun, APatternGrowsOnATileAtItsSize) {
  for (const bool bent : {false, true})
    for (const StepperKind* stepper : {&sbdf2, &rkc2}) {
      Growth run = grow_on(tile(64, bent), "turing", *stepper, 0.2);
      run.advance(1'000'000);
      ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
      EXPECT_FALSE(run.uniform());
      EXPECT_NEAR(measured_wavelength(*run.space().sampled(SampleRule::vertices).mass, *run.space().stiffness(),
                                      run.coefficients()[0]) /
                      0.2,
                  1, 0.15)
          << stepper->name << bent;
    }
}

TEST(GridRun, SteppersOfFirstOrderAndGradientsWorkOnIt) {
  for (const StepperKind* stepper : {&semi_implicit, &explicit_euler}) {
    Growth run = grow_on(tile(24, true), "turing", *stepper, 0.4);
    run.advance(50);
    ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  }
  Growth chaos = grow_on(tile(32, false), "kuramoto-sivashinsky", sbdf2, 0.25);
  chaos.advance(300);
  ASSERT_NE(chaos.summary().status, RunStatus::failed) << chaos.summary().message;
}

TEST(GridRun, MasksGrowWhatTheyOnlyHaveToBeAppliedFor) {
  Growth run = grow_on(tile(64, false), "turing", rkc2, 0.2, mask_method);
  run.advance(1'000'000);
  ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  EXPECT_NEAR(measured_wavelength(*run.space().sampled(SampleRule::vertices).mass, *run.space().stiffness(),
                                  run.coefficients()[0]) /
                  0.2,
              1, 0.15);
  Growth simple = grow_on(tile(24, false), "turing", explicit_euler, 0.4, mask_method);
  simple.advance(50);
  ASSERT_NE(simple.summary().status, RunStatus::failed) << simple.summary().message;
}

std::string refusal(const std::string& method, const std::string& stepper, const std::string& model) {
  Recipe recipe;
  recipe.stages[0].method = {method, {"--method"}};
  recipe.stages[0].stepper = {stepper, {"--stepper"}};
  recipe.stages[0].model = {model, {}};
  try {
    plan(recipe);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(GridRun, MasksAreNotSymmetricAndSteppersThatSolveAreRefused) {
  EXPECT_EQ(refusal("masks", "", "turing"), "");
  EXPECT_EQ(refusal("masks", "explicit", "turing"), "");
  for (const char* stepper : {"sbdf2", "semi-implicit"})
    EXPECT_NE(refusal("masks", stepper, "turing").find("not symmetric; take another stepper"), std::string::npos);
  for (const char* stepper : {"", "explicit"})
    EXPECT_NE(refusal("masks", stepper, "swift-hohenberg").find("not symmetric"), std::string::npos);
}

}  // namespace
}  // namespace pelage
