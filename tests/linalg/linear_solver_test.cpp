#include "linalg/linear_solver.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "discretise/method.h"
#include "linalg/sor.h"

namespace pelage {
namespace {

/// M + dt K of an even closed sheet of n x n nodes.
SparseMatrix step_matrix(std::int32_t n, double dt) {
  Grid grid;
  grid.count = {n, n, 1};
  const auto space = grid_method.make_node_space(grid);
  SparseMatrix matrix;
  combine(1, *space->sampled(SampleRule::vertices).mass, dt, *space->stiffness(), matrix);
  return matrix;
}

Vector noise(Eigen::Index count) {
  Vector b(count);
  for (Eigen::Index i = 0; i < count; ++i) b[i] = uniform(3, static_cast<std::uint64_t>(i)) - 0.5;
  return b;
}

TEST(LinearSolver, AllKindsAgree) {
  const SparseMatrix a = step_matrix(24, 4);
  const Vector b = noise(a.rows()), expected = solve_spd(a, b, {.tolerance = 1e-14});
  Held held(static_cast<std::size_t>(a.rows()), 0);
  for (std::size_t i = 0; i < 24; ++i) held[i] = 1;
  Vector first;
  for (const SolverKind* kind : solver_kinds()) {
    const auto solver = kind->make();
    solver->update(a);
    Vector x = Vector::Zero(a.rows());
    EXPECT_TRUE(solver->solve(b, x, nullptr, 1e-13).converged) << kind->name;
    EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm()) << kind->name;
    Vector y = Vector::Ones(a.rows());
    EXPECT_TRUE(solver->solve(b, y, &held, 1e-13).converged) << kind->name;
    EXPECT_EQ(y.head(24), Vector(Vector::Ones(24))) << kind->name;
    if (first.size() == 0) first = y;
    EXPECT_LT((y - first).norm(), 1e-10 * first.norm()) << kind->name;
  }
}

/// A solver goes on with another matrix, of another pattern.
TEST(LinearSolver, TakesOneMatrixAfterTheOther) {
  for (const SolverKind* kind : solver_kinds()) {
    const auto solver = kind->make();
    for (const auto& [n, dt] : {std::pair{12, 1.0}, {12, 20.0}, {9, 3.0}}) {
      const SparseMatrix a = step_matrix(n, dt);
      solver->update(a);
      const Vector b = noise(a.rows());
      Vector x = Vector::Zero(a.rows());
      solver->solve(b, x, nullptr, 1e-12);
      EXPECT_LT((a * x - b).norm(), 1e-11 * b.norm()) << kind->name;
    }
  }
}

/// The factor is within a third of the sweeps of the best of 18.
TEST(LinearSolver, RelaxationIsNearlyTheBest) {
  for (const double dt : {1.0, 20.0, 400.0}) {
    const SparseMatrix a = step_matrix(40, dt);
    const Vector b = noise(a.rows());
    int fewest = 1 << 30;
    for (double w = 1.05; w < 1.99; w += 0.05) {
      Vector x = Vector::Zero(a.rows());
      fewest = std::min(fewest, successive_over_relaxation(a, SweepColours(*a.pattern), b, x, nullptr,
                                                           {.relaxation = w, .tolerance = 1e-8})
                                    .iterations);
    }
    const auto solver = coloured_sweeps.make();
    solver->update(a);
    Vector x = Vector::Zero(a.rows());
    EXPECT_LE(solver->solve(b, x, nullptr, 1e-8).iterations, 4 * fewest / 3 + 10) << dt;
  }
}

}  // namespace
}  // namespace pelage
