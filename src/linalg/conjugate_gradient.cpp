#include "linalg/conjugate_gradient.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <cmath>

#include "base/checked.h"
#include "base/number.h"
#include "pelage/error.h"

namespace pelage {

Vector solve_spd(const SparseMatrix& a, const Vector& b, const ConjugateGradientOptions& options) {
  Vector x = Vector::Zero(b.size());
  ConjugateGradientWork<Vector> work;
  const SolveReport report = conjugate_gradient(a, Jacobi(diagonal(a)), b, x, nullptr, options, work);
  if (!report.converged)
    throw Error(Fault::numerics, "a linear system did not converge (residual " + number(report.residual) + " after " +
                                     std::to_string(report.iterations) +
                                     " iterations); the mesh may have triangles without area");
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
