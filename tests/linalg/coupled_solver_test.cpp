#include "linalg/coupled_solver.h"

#include <gtest/gtest.h>

#include "base/dense.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using Eigen::MatrixXd;
using testing::chain;
using testing::dense;
using testing::random_vector;

constexpr std::int32_t size = 40;

/// All have one pattern, as the matrices of a space do.
SparseMatrix shared_chain(double diagonal) {
  static const auto pattern = chain(size, 1).pattern;
  SparseMatrix a = chain(size, diagonal);
  a.pattern = pattern;
  return a;
}

/// The stiffness of a chain with free ends: constants are in its kernel.
SparseMatrix free_chain() {
  SparseMatrix k = shared_chain(2);
  k.value.front() = k.value.back() = 1;
  return k;
}

struct Solved {
  SolveReport report;
  std::vector<Vector> b, x;
};

Solved solve(const MatrixXd& c, const ConjugateGradientOptions& options = {.tolerance = 1e-13}) {
  Solved s;
  for (Eigen::Index i = 0; i < c.rows(); ++i) {
    s.b.push_back(random_vector(size, static_cast<std::uint64_t>(i) + 1).array() + 1.0);
    s.x.push_back(random_vector(size, static_cast<std::uint64_t>(i) + 70));
  }
  const auto mass = std::make_shared<const SparseMatrix>(shared_chain(4)),
             stiffness = std::make_shared<const SparseMatrix>(free_chain());
  CoupledSolver solver;
  solver.update(mass, stiffness, c);
  s.report = solver.solve(s.b, s.x, options);
  return s;
}

/// The block matrix with C_ij K + delta_ij M at block (i, j), eliminated densely.
std::vector<Vector> solved_densely(const MatrixXd& c, const std::vector<Vector>& b) {
  const MatrixXd mass = dense(shared_chain(4)), stiffness = dense(free_chain());
  MatrixXd a(c.rows() * size, c.rows() * size);
  Vector rhs(c.rows() * size);
  for (Eigen::Index i = 0; i < c.rows(); ++i) {
    rhs.segment(i * size, size) = b[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < c.rows(); ++j)
      a.block(i * size, j * size, size, size) = (i == j ? 1.0 : 0.0) * mass + c(i, j) * stiffness;
  }
  const Vector all = solved(a, rhs);
  std::vector<Vector> x;
  for (Eigen::Index i = 0; i < c.rows(); ++i) x.push_back(all.segment(i * size, size));
  return x;
}

void expect_dense_solution(const MatrixXd& c) {
  const Solved s = solve(c);
  EXPECT_TRUE(s.report.converged);
  const std::vector<Vector> expected = solved_densely(c, s.b);
  for (std::size_t i = 0; i < s.x.size(); ++i)
    EXPECT_LT((s.x[i] - expected[i]).norm(), 1e-10 * expected[i].norm()) << "field " << i << " of\n" << c;
}

TEST(CoupledSolver, AgreesWithDenseElimination) {
  expect_dense_solution(MatrixXd::Constant(1, 1, 0.7));
  expect_dense_solution(MatrixXd{{0, -0.3}, {1, 0}});                 // biharmonic: a pair +- i sqrt(0.3)
  expect_dense_solution(MatrixXd{{2, 1}, {-1, 0}});                   // one eigenvalue twice, one eigenvector
  expect_dense_solution(MatrixXd{{1, 5}, {0, 1}});                    // the same, triangular
  expect_dense_solution(MatrixXd{{1, -2}, {2, 1}});                   // Ginzburg-Landau
  expect_dense_solution(MatrixXd{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}});  // sixth order: one real, one pair
  expect_dense_solution(MatrixXd{{0, -0.3, 0.4, 0}, {1, 0, 0, 0.2}, {0.1, 0, 2, -1}, {0, 0, 3, 1}});
}

/// Summed over its rows, equation i is 1.M x_i = 1.b_i, since 1.K = 0.
TEST(CoupledSolver, SumsHoldHoweverLooseTheToleranceIs) {
  const SparseMatrix mass = shared_chain(4);
  for (const MatrixXd& c : {MatrixXd{{0, -0.3}, {1, 0}}, MatrixXd{{2, 1}, {0.3, 1}}}) {
    const Solved s = solve(c, {.tolerance = 1e-2});
    EXPECT_GT(s.report.residual, 1e-6);
    for (std::size_t i = 0; i < s.x.size(); ++i) EXPECT_NEAR((mass * s.x[i]).sum(), s.b[i].sum(), 1e-12);
  }
}

TEST(CoupledSolver, NoticesAnIndefiniteMatrix) {
  EXPECT_FALSE(solve(MatrixXd{{-3, 0}, {1, 1}}).report.positive_definite);
}

TEST(CoupledSolver, TakesNewCoefficients) {
  const auto mass = std::make_shared<const SparseMatrix>(shared_chain(4)),
             stiffness = std::make_shared<const SparseMatrix>(free_chain());
  CoupledSolver solver;
  std::vector<Vector> b = {random_vector(size, 1), random_vector(size, 2)};
  for (const MatrixXd& c : {MatrixXd{{0, -0.3}, {1, 0}}, MatrixXd{{0, -0.6}, {1, 0}}}) {
    std::vector<Vector> x = b;
    solver.update(mass, stiffness, c);
    solver.solve(b, x, {.tolerance = 1e-13});
    EXPECT_LT((x[0] - solved_densely(c, b)[0]).norm(), 1e-10);
  }
}

/// A matrix with other values is another object.
TEST(CoupledSolver, TakesNewMatrices) {
  const MatrixXd c{{0, -0.3}, {1, 0}};
  const auto stiffness = std::make_shared<const SparseMatrix>(free_chain());
  CoupledSolver solver;
  const std::vector<Vector> b = {random_vector(size, 1), random_vector(size, 2)};
  solver.update(std::make_shared<const SparseMatrix>(shared_chain(8)), stiffness, c);
  solver.update(std::make_shared<const SparseMatrix>(shared_chain(4)), stiffness, c);
  std::vector<Vector> x = b;
  solver.solve(b, x, {.tolerance = 1e-13});
  EXPECT_LT((x[0] - solved_densely(c, b)[0]).norm(), 1e-10);
}

}  // namespace
}  // namespace pelage
