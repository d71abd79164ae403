#include "linalg/conjugate_gradient.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <cmath>

#include "base/checked.h"
#include "base/number.h"
#include "base/parallel.h"
#include "pelage/error.h"

namespace pelage {

namespace {

using Sums = Eigen::Array2d;

/// x += alpha p, r -= alpha q; returns (r . r, r . D^-1 r), where D^-1 is not 0: one pass over memory instead of four.
Sums update(double alpha, const Vector& p, const Vector& q, const Vector& inverse_diagonal, Vector& x, Vector& r) {
  return ordered_sum(static_cast<std::size_t>(x.size()), Sums{0, 0}, [&](std::size_t begin, std::size_t end) {
    double rr = 0, rz = 0;
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
      const double square = r[i] * r[i];
      rr += inverse_diagonal[i] != 0 ? square : 0;
      rz += square * inverse_diagonal[i];
    }
    return Sums{rr, rz};
  });
}

/// p = D^-1 r + beta p.
void next_direction(const Vector& r, const Vector& inverse_diagonal, double beta, Vector& p) {
  parallel_for(static_cast<std::size_t>(p.size()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i)
      p[i] = inverse_diagonal[i] * r[i] + beta * p[i];
  });
}

}  // namespace

SolveReport ConjugateGradient::solve(const SparseMatrix& a, const Vector& inverse_diagonal, const Vector& b, Vector& x,
                                     const ConjugateGradientOptions& options) {
  SolveReport report;
  const double b_norm = std::sqrt(dot(b, b));
  if (b_norm == 0) {
    x.setZero(b.size());
    report.converged = true;
    return report;
  }
  if (!std::isfinite(b_norm)) {  // no residual is small or large beside it
    report.residual = b_norm;
    return report;
  }
  apply(a, x, q_);
  r_.resize(b.size());
  p_.setZero(b.size());
  r_ = b;
  Sums sums = update(1, p_, q_, inverse_diagonal, x, r_);  // r = b - A x, as p is zero
  const double target = options.tolerance * b_norm;
  double rz_old = 0;
  while (true) {
    report.residual = std::sqrt(sums[0]) / b_norm;
    report.converged = std::sqrt(sums[0]) <= target;
    if (report.converged || report.iterations >= options.max_iterations || !std::isfinite(sums[0])) return report;
    next_direction(r_, inverse_diagonal, rz_old == 0 ? 0 : sums[1] / rz_old, p_);
    apply(a, p_, q_);
    const double curvature = dot(p_, q_);
    if (!(curvature > 0)) {
      report.positive_definite = false;
      return report;
    }
    rz_old = sums[1];
    sums = update(rz_old / curvature, p_, q_, inverse_diagonal, x, r_);
    ++report.iterations;
  }
}

Vector solve_spd(const SparseMatrix& a, const Vector& b, const ConjugateGradientOptions& options) {
  Vector x = Vector::Zero(b.size());
  const Vector inverse_diagonal = diagonal(a).cwiseInverse();
  const SolveReport report = ConjugateGradient().solve(a, inverse_diagonal, b, x, options);
  if (!report.converged)
    throw Error(Fault::numerics, "a linear system did not converge (residual " + number(report.residual) + " after " +
                                     std::to_string(report.iterations) + " iterations)");
  return x;
}

Vector solve_general(const SparseMatrix& a, const Vector& b, double tolerance) {
  using EigenMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
  const auto entries = checked_count<std::int32_t>(a.value.size(), "entries of a matrix");
  std::vector<std::int32_t> start(a.pattern->start.begin(), a.pattern->start.end());
  const Eigen::Map<const EigenMatrix> matrix(a.rows(), a.columns(), entries, start.data(), a.pattern->column.data(),
                                             a.value.data());
  Eigen::BiCGSTAB<EigenMatrix> solver;
  solver.setTolerance(tolerance);
  solver.compute(matrix);
  const Vector x = solver.solveWithGuess(b, b);
  if (!(solver.error() <= 1e3 * tolerance))
    throw Error(Fault::numerics, "a limit-surface system did not converge (residual " + number(solver.error()) +
                                     "); the mesh may have extreme valences");
  return x;
}

}  // namespace pelage
