// Implicit steps with every solver of their linear systems.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretise/method.h"
#include "support/space_system.h"
#include "support/steppers.h"

namespace pelage {
namespace {

std::shared_ptr<const Space> bent_sheet() {
  constexpr std::int32_t n = 20;
  Grid grid;
  grid.count = {n, n, 1};
  for (std::int32_t v = 0; v < n * n; ++v) {
    const double x = static_cast<double>(v % n) / (n - 1), y = static_cast<double>(v / n) / (n - 1);
    grid.points.push_back({x + 0.3 * x * (1 - x) * y, y + 0.2 * std::sin(3 * x) * y * (1 - y), 0.3 * x * y});
  }
  return grid_method.make_node_space(grid);
}

struct Grown {
  std::vector<Vector> fields;
  int iterations = 0, solves = 0;
};

/// Four steps of a pair that is made where one is more than the other, which all of these steppers grow.
Grown grown(const StepperKind& stepper, const SolverKind& solver, const std::vector<Vector>* start = nullptr) {
  SpaceSystem s(bent_sheet(), stepper.samples);
  s.add_species(0.02, [](const Point& p) { return std::sin(9 * p[0]) + 0.2; });
  s.add_species(0.005, [](const Point& p) { return std::cos(7 * p[1]); });
  if (start) s.state.now = *start;
  set_reaction(s.system, [](const std::vector<double>& u, double, std::vector<double>& c2, std::vector<double>& c3) {
    c2 = {-1, -1};
    c3[0] = c3[1] = u[1] > u[0] ? 1 : 0;
  });
  const auto instance = stepper.make();
  Grown result;
  for (int k = 0; k < 4; ++k) {
    const StepReport report = instance->step(
        s.system, s.state, {.dt = stepper.adaptive ? 0.05 : 0.002, .solver_tolerance = 1e-13, .solver = &solver});
    EXPECT_TRUE(report.accepted) << stepper.name << " " << solver.name << ": " << report.failure;
    result.iterations += report.iterations;
    result.solves += report.solves;
  }
  result.fields = s.state.now;
  return result;
}

TEST(SolverChoice, EverySolverGivesTheSameSteps) {
  int steppers = 0;
  for (const StepperKind* stepper : stepper_kinds()) {
    if (!stepper->solves) continue;
    ++steppers;
    // Sign iteration solves loosely while rates jump, and there is more than one rest: it begins where none jumps.
    std::vector<Vector> rest = grown(*stepper, jacobi_gradients).fields;
    for (Vector& u : rest) u *= 1.1;
    const std::vector<Vector>* start = stepper == &sign_iteration ? &rest : nullptr;
    const Grown expected = grown(*stepper, jacobi_gradients, start);
    EXPECT_GT(expected.solves, 0);
    std::vector<int> iterations = {expected.iterations};
    for (const SolverKind* solver : solver_kinds().subspan(1)) {
      const Grown other = grown(*stepper, *solver, start);
      for (std::size_t i : {0, 1})
        EXPECT_LT((other.fields[i] - expected.fields[i]).norm(), 1e-10 * expected.fields[i].norm())
            << stepper->name << " " << solver->name;
      iterations.push_back(other.iterations);
    }
    EXPECT_GT(std::ranges::max(iterations), std::ranges::min(iterations)) << stepper->name;  // others were at work
  }
  EXPECT_EQ(steppers, 4);
}

TEST(SolverChoice, StepsGoOnWithAnotherSolver) {
  SpaceSystem s(bent_sheet());
  s.add_species(0.02, [](const Point& p) { return std::sin(9 * p[0]); });
  const auto stepper = sbdf2.make();
  for (const SolverKind* solver : solver_kinds())
    EXPECT_TRUE(stepper->step(s.system, s.state, {.dt = 0.01, .solver = solver}).accepted) << solver->name;
}

}  // namespace
}  // namespace pelage
