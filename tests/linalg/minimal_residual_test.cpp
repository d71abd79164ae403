#include "linalg/minimal_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/dense.h"
#include "linalg/linear_solver.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::chain;
using testing::dense;
using testing::random_vector;

constexpr ConjugateGradientOptions exact{.tolerance = 1e-12, .max_iterations = 5000};

TEST(MinimalResiduals, SolvesIndefiniteSystems) {
  for (const double centre : {-2.5, -0.5, 0.0, 0.7, 2.5}) {
    const SparseMatrix a = chain(60, centre);
    const Vector b = random_vector(60, 3);
    const Vector expected = solved(dense(a), b);
    Vector x = random_vector(60, 4);
    const SolveReport report = minimal_residuals(a, b, x, nullptr, exact);
    EXPECT_TRUE(report.converged) << centre;
    EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm()) << centre;
  }
}

/// A system of n unknowns is done after n steps, up to rounding.
TEST(MinimalResiduals, EndsAfterAsManyStepsAsThereAreUnknowns) {
  const SparseMatrix a = chain(12, 0.7);
  Vector x = Vector::Zero(12);
  const SolveReport report = minimal_residuals(a, random_vector(12, 5), x, nullptr, {.tolerance = 1e-9});
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 13);
}

/// The equations of the others with the held values on their right-hand side.
TEST(MinimalResiduals, HeldUnknownsStay) {
  const SparseMatrix a = chain(40, 0.7);
  const Vector b = random_vector(40, 6);
  Vector x = random_vector(40, 7);
  Held held(40, 0);
  Eigen::MatrixXd rows = dense(a);
  Vector right = b;
  for (const Eigen::Index i : {0, 11, 25}) {
    held[static_cast<std::size_t>(i)] = 1;
    rows.row(i).setZero();
    rows(i, i) = 1;
    right[i] = x[i];
  }
  const Vector expected = solved(rows, right);
  ASSERT_TRUE(minimal_residuals(a, b, x, &held, exact).converged);
  EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm());
  for (const Eigen::Index i : {0, 11, 25}) EXPECT_EQ(x[i], expected[i]);
}

TEST(MinimalResiduals, SaysWhenItDoesNotConverge) {
  const SparseMatrix a = chain(1000, 0.1);
  Vector x = Vector::Zero(1000);
  const SolveReport report =
      minimal_residuals(a, random_vector(1000, 6), x, nullptr, {.tolerance = 1e-12, .max_iterations = 10});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 10);
  Vector b = Vector::Ones(1000);
  b[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(minimal_residuals(a, b, x, nullptr, exact).converged);
}

TEST(LinearSolver, GradientsGoOnByMinimalResiduals) {
  const SparseMatrix a = chain(60, 0.7);
  const Vector b = random_vector(60, 8), expected = solved(dense(a), b);
  for (const SolverKind* kind : {&jacobi_gradients, &plain_gradients}) {
    const auto solver = kind->make();
    solver->update(a);
    Vector x = Vector::Zero(60);
    const SolveReport report = solver->solve(b, x, nullptr, 1e-12);
    EXPECT_TRUE(report.converged);
    EXPECT_FALSE(report.positive_definite);
    EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm()) << kind->name;
  }
}

}  // namespace
}  // namespace pelage
