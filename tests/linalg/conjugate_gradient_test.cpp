#include "linalg/conjugate_gradient.h"

#include <gtest/gtest.h>

#include "base/dense.h"
#include "base/parallel.h"
#include "pelage/error.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::chain;
using testing::dense;
using testing::random_vector;

SolveReport solve(const SparseMatrix& a, const Vector& b, Vector& x, const ConjugateGradientOptions& options = {},
                  const Held* held = nullptr) {
  ConjugateGradientWork<Vector> work;
  return conjugate_gradient(a, Jacobi(diagonal(a)), b, x, held, options, work);
}

TEST(ConjugateGradient, AgreesWithDenseCholesky) {
  SparseMatrix a = chain(80, 2.05);
  for (std::int32_t i = 0; i < 80; ++i) {  // scaled from both sides, so that the preconditioner has something to do
    const double scale = 1 + i % 7;
    for (auto k = a.pattern->start[i]; k < a.pattern->start[i + 1]; ++k)
      a.value[static_cast<std::size_t>(k)] *= scale * (1 + a.pattern->column[static_cast<std::size_t>(k)] % 7);
  }
  const Vector b = random_vector(80, 1);
  const Vector expected = solved(dense(a), b);
  const Vector x = solve_spd(a, b, {.tolerance = 1e-13});
  EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm());
}

TEST(ConjugateGradient, EndsAfterAsManyStepsAsThereAreUnknowns) {
  const SparseMatrix a = chain(12, 3);
  Vector x = Vector::Zero(12);
  const SolveReport report = solve(a, random_vector(12, 2), x, {.tolerance = 1e-13});
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 12);
}

TEST(ConjugateGradient, TheSolutionAsFirstGuessNeedsNoIteration) {
  const SparseMatrix a = chain(50, 2.5);
  const Vector b = random_vector(50, 3);
  Vector x = solve_spd(a, b, {.tolerance = 1e-14});
  EXPECT_EQ(solve(a, b, x).iterations, 0);
}

/// The same by rows of the unit matrix; where nothing but held values drives the others, too.
TEST(ConjugateGradient, HeldUnknownsKeepTheirValues) {
  const SparseMatrix a = chain(40, 2.2);
  for (const Vector& b : {random_vector(40, 4), Vector(Vector::Zero(40))}) {
    const Vector guess = random_vector(40, 5);
    Held held(40, 0);
    Eigen::MatrixXd system = dense(a);
    Vector right = b;
    for (Eigen::Index i = 0; i < 40; i += 3) {
      held[static_cast<std::size_t>(i)] = 1;
      system.row(i).setZero();
      system(i, i) = 1;
      right[i] = guess[i];
    }
    Vector x = guess;
    EXPECT_TRUE(solve(a, b, x, {.tolerance = 1e-13}, &held).converged);
    const Vector expected = solved(system, right);
    EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm());
    for (Eigen::Index i = 0; i < 40; i += 3) EXPECT_EQ(x[i], guess[i]);
  }
}

/// Symmetric Gauss-Seidel, written by itself: the solver knows no preconditioner by name.
class GaussSeidel {
 public:
  explicit GaussSeidel(const SparseMatrix& a) : a_(dense(a)) {}
  ResidualSums<double> update(double alpha, const Vector& p, const Vector& q, const Held*, Vector& x, Vector& r) const {
    x += alpha * p;
    r -= alpha * q;
    return {r.squaredNorm(), r.dot(apply(r))};
  }
  void next_direction(const Vector& r, double beta, const Held*, Vector& p) const { p = apply(r) + beta * p; }

 private:
  Vector apply(const Vector& r) const {
    const Vector y = a_.triangularView<Eigen::Lower>().solve(r);
    return a_.triangularView<Eigen::Upper>().solve(Vector(a_.diagonal().cwiseProduct(y)));
  }
  Eigen::MatrixXd a_;
};

TEST(ConjugateGradient, TakesAnyPreconditioner) {
  const SparseMatrix a = chain(200, 2.001);
  const Vector b = random_vector(200, 6);
  Vector x = Vector::Zero(200), y = x;
  ConjugateGradientWork<Vector> work;
  const SolveReport report = conjugate_gradient(a, GaussSeidel(a), b, x, nullptr, {.tolerance = 1e-12}, work);
  const SolveReport plain = solve(a, b, y, {.tolerance = 1e-12});
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, plain.iterations);
  EXPECT_LT((x - y).norm(), 1e-8 * y.norm());
}

TEST(ConjugateGradient, ZeroRightSideHasTheZeroSolution) {
  const SparseMatrix a = chain(20, 2.5);
  Vector x = random_vector(20, 4);
  EXPECT_TRUE(solve(a, Vector::Zero(20), x).converged);
  EXPECT_EQ(x, Vector(Vector::Zero(20)));
}

TEST(ConjugateGradient, NoticesAMatrixThatIsNotPositiveDefinite) {
  const SparseMatrix a = chain(50, 0.5);
  Vector x = Vector::Zero(50);
  const SolveReport report = solve(a, random_vector(50, 5), x);
  EXPECT_FALSE(report.positive_definite);
  EXPECT_FALSE(report.converged);
  EXPECT_THROW(solve_spd(a, random_vector(50, 5)), Error);
}

TEST(ConjugateGradient, SaysWhenItDoesNotConverge) {
  const SparseMatrix a = chain(1000, 2 + 1e-6);
  Vector x = Vector::Zero(1000);
  const SolveReport report = solve(a, random_vector(1000, 6), x, {.tolerance = 1e-12, .max_iterations = 10});
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(report.positive_definite);
  EXPECT_EQ(report.iterations, 10);
  EXPECT_GT(report.residual, 1e-12);
}

/// Every residual would be at most a fraction of an infinite right side.
TEST(ConjugateGradient, InfiniteRightSidesDoNotConverge) {
  const SparseMatrix a = chain(20, 2.5);
  for (double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 1e200}) {
    Vector x = Vector::Zero(20), b = Vector::Ones(20);
    b[7] = bad;
    EXPECT_FALSE(solve(a, b, x).converged);
  }
}

TEST(ConjugateGradient, SameBitsForAnyNumberOfThreads) {
  const SparseMatrix a = chain(50000, 2.01);
  const Vector b = random_vector(50000, 7);
  const Vector all = solve_spd(a, b);
  const ThreadLimit one(1);
  EXPECT_EQ(solve_spd(a, b), all);
}

TEST(SolveGeneral, AgreesWithDenseElimination) {
  SparseMatrix b = chain(90, 4);  // made unsymmetric
  for (std::size_t k = 0; k < b.value.size(); ++k) b.value[k] += 0.5 * (uniform(9, k) - 0.5);
  const Vector rhs = random_vector(90, 10);
  EXPECT_LT((solve_general(b, rhs) - solved(dense(b), rhs)).norm(), 1e-10);
}

TEST(SolveGeneral, RefusesASingularMatrix) {
  SparseMatrix a = chain(10, 4);
  for (auto k = a.pattern->start[5]; k < a.pattern->start[6]; ++k) a.value[static_cast<std::size_t>(k)] = 0;
  EXPECT_THROW(solve_general(a, Vector::Ones(10)), Error);
}

}  // namespace
}  // namespace pelage
