#include "linalg/coupled_solver.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace pelage {

namespace {

void join(const SolveReport& part, SolveReport& whole) {
  whole.iterations += part.iterations;
  whole.residual = std::max(whole.residual, part.residual);
  whole.converged = whole.converged && part.converged;
  whole.positive_definite = whole.positive_definite && part.positive_definite;
}

}  // namespace

void CoupledSolver::update(std::shared_ptr<const SparseMatrix> mass, std::shared_ptr<const SparseMatrix> stiffness,
                           const Eigen::MatrixXd& c) {
  if (mass_ == mass && stiffness_ == stiffness && c_.rows() == c.rows() && c_ == c) return;
  mass_ = std::move(mass);
  stiffness_ = std::move(stiffness);
  c_ = c;
  const Eigen::RealSchur<Eigen::MatrixXd> schur(c);
  q_ = schur.matrixU();
  t_ = schur.matrixT();
  integral_ = *mass_ * Vector::Ones(mass_->rows());
  blocks_.clear();
  for (Eigen::Index i = 0; i < c.rows(); i += blocks_.back().size) blocks_.push_back(make_block(i));
}

CoupledSolver::Block CoupledSolver::make_block(Eigen::Index first) const {
  Block block;
  block.first = first;
  if (first + 1 == t_.rows() || t_(first + 1, first) == 0) {
    combine(1, *mass_, t_(first, first), *stiffness_, block.real);
    block.preconditioner = Jacobi(diagonal(block.real));
    return block;
  }
  block.size = 2;
  // The left eigenvector (1, second) of the 2 x 2 block for the eigenvalue t.
  const double a = t_(first, first), b = t_(first, first + 1), c = t_(first + 1, first), d = t_(first + 1, first + 1);
  const double mean = (a + d) / 2, half = (a - d) / 2;
  const std::complex<double> t(mean, std::sqrt(-(half * half + b * c)));
  block.second = (t - a) / c;
  combine(*mass_, t, *stiffness_, block.complex);
  block.complex_preconditioner = Jacobi(ComplexVector(diagonal(*mass_) + t * diagonal(*stiffness_)));
  return block;
}

SolveReport CoupledSolver::solve_real(const Block& block, const Vector& f, Vector& y,
                                      const ConjugateGradientOptions& options) {
  const SolveReport report = conjugate_gradient(block.real, block.preconditioner, f, y, nullptr, options, real_work_);
  y.array() += (f.sum() - dot(integral_, y)) / integral_.sum();
  return report;
}

SolveReport CoupledSolver::solve_pair(const Block& block, const Vector& f1, const Vector& f2, Vector& y1, Vector& y2,
                                      const ConjugateGradientOptions& options) {
  const ComplexVector f = f1 + block.second * f2;
  ComplexVector z = y1 + block.second * y2;
  const SolveReport report =
      conjugate_gradient(block.complex, block.complex_preconditioner, f, z, nullptr, options, complex_work_);
  y2 = z.imag() / block.second.imag();
  y1 = z.real() - block.second.real() * y2;
  y1.array() += (f1.sum() - dot(integral_, y1)) / integral_.sum();
  y2.array() += (f2.sum() - dot(integral_, y2)) / integral_.sum();
  return report;
}

/// Q x over the fields.
std::vector<Vector> CoupledSolver::rotated(const Eigen::MatrixXd& q, const std::vector<Vector>& fields) const {
  std::vector<Vector> result(fields.size(), Vector::Zero(fields.front().size()));
  for (std::size_t i = 0; i < fields.size(); ++i)
    for (std::size_t j = 0; j < fields.size(); ++j)
      axpby(q(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), fields[j], 1, result[i]);
  return result;
}

SolveReport CoupledSolver::solve(const std::vector<Vector>& b, std::vector<Vector>& x,
                                 const ConjugateGradientOptions& options) {
  assert(static_cast<Eigen::Index>(b.size()) == c_.rows() && x.size() == b.size());
  std::vector<Vector> f = rotated(q_.transpose(), b), y = rotated(q_.transpose(), x);
  SolveReport report;
  report.converged = true;
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
    const auto i = static_cast<std::size_t>(block->first);
    join(block->size == 1 ? solve_real(*block, f[i], y[i], options)
                          : solve_pair(*block, f[i], f[i + 1], y[i], y[i + 1], options),
         report);
    for (Eigen::Index k = block->first; k < block->first + block->size && block->first > 0; ++k) {
      const Vector flux = *stiffness_ * y[static_cast<std::size_t>(k)];
      for (Eigen::Index row = 0; row < block->first; ++row)
        axpby(-t_(row, k), flux, 1, f[static_cast<std::size_t>(row)]);
    }
  }
  x = rotated(q_, y);
  return report;
}

}  // namespace pelage
