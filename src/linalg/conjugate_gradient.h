#pragma once
// Preconditioned conjugate gradients (Hestenes, Stiefel 1952) for real symmetric positive definite systems, and the
// same recurrences with a product in which nothing is conjugated for complex symmetric ones, A = A' (conjugate
// orthogonal conjugate gradients: van der Vorst, Melissen 1990).

#include <cmath>

#include "base/parallel.h"
#include "linalg/complex_symmetric.h"
#include "linalg/sparse.h"

namespace pelage {

struct SolveReport {
  int iterations = 0;
  double residual = 0;  ///< |b - A x| / |b| over the unknowns that are solved for, as updated by the recurrence
  bool converged = false;
  bool positive_definite = true;  ///< false: a direction of non-positive curvature was met, and the solve given up
};

struct ConjugateGradientOptions {
  double tolerance = 1e-10;  ///< on |b - A x| / |b|. A warm start satisfies a loose tolerance without any iteration
                             ///< while a pattern still grows slowly: keep it far below the change of one step.
  int max_iterations = 2000;
};

/// Per unknown, whether it keeps the value of the first guess; null where none does.
using Held = std::vector<char>;

/// Zeros at the unknowns that are held.
inline void clear_held(const Held* held, Vector& x) {
  if (!held) return;
  parallel_for(held->size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if ((*held)[k]) x.data()[k] = 0;
  });
}

/// What the next direction needs of a residual r: |r|^2, and r . P r without conjugation.
template <class Scalar>
struct ResidualSums {
  double rr = 0;
  Scalar rz = 0;
  ResidualSums& operator+=(const ResidualSums& other) {
    rr += other.rr;
    rz += other.rz;
    return *this;
  }
};

/// P = D^-1. A preconditioner takes part in the two passes over memory of an iteration, in which it may fuse its own.
template <class VectorT>
class Jacobi {
 public:
  using Scalar = typename VectorT::Scalar;
  Jacobi() = default;
  /// Rows of 0, those of vertices without triangles, are left as they are.
  explicit Jacobi(VectorT diagonal) : inverse_(std::move(diagonal)) {
    for (auto& d : inverse_) d = std::abs(d) > 0 ? 1.0 / d : Scalar(1);
  }

  /// x += alpha p, r -= alpha q.
  ResidualSums<Scalar> update(Scalar alpha, const VectorT& p, const VectorT& q, const Held* held, VectorT& x,
                              VectorT& r) const {
    return ordered_sum(static_cast<std::size_t>(x.size()), ResidualSums<Scalar>{},
                       [&](std::size_t begin, std::size_t end) {
                         ResidualSums<Scalar> sums;
                         for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
                           if (held && (*held)[static_cast<std::size_t>(i)]) continue;
                           x[i] += times(alpha, p[i]);
                           r[i] -= times(alpha, q[i]);
                           sums.rr += square_of_magnitude(r[i]);
                           sums.rz += times(times(r[i], r[i]), inverse_[i]);
                         }
                         return sums;
                       });
  }
  /// p = P r + beta p.
  void next_direction(const VectorT& r, Scalar beta, const Held* held, VectorT& p) const {
    parallel_for(static_cast<std::size_t>(p.size()), [&](std::size_t begin, std::size_t end) {
      for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
        if (held && (*held)[static_cast<std::size_t>(i)]) continue;
        p[i] = times(inverse_[i], r[i]) + times(beta, p[i]);
      }
    });
  }

 private:
  VectorT inverse_;
};

/// Vectors of a solve, kept between solves of the same size.
template <class VectorT>
struct ConjugateGradientWork {
  VectorT r, p, q;
};

/// Solves A x = b; x holds the first guess and the result. Equations of held unknowns do not count.
template <class Matrix, class Preconditioner, class VectorT>
SolveReport conjugate_gradient(const Matrix& a, const Preconditioner& preconditioner, const VectorT& b, VectorT& x,
                               const Held* held, const ConjugateGradientOptions& options,
                               ConjugateGradientWork<VectorT>& work) {
  using Scalar = typename VectorT::Scalar;
  SolveReport report;
  const double b_norm = norm(b);
  if (b_norm == 0 && !held) {
    x.setZero(b.size());
    report.converged = true;
    return report;
  }
  if (!std::isfinite(b_norm)) {  // no residual is small or large beside it
    report.residual = b_norm;
    return report;
  }
  auto& [r, p, q] = work;
  apply(a, x, q);
  r = b;
  p.setZero(b.size());
  auto sums = preconditioner.update(Scalar(1), p, q, held, x, r);  // r = b - A x, as p is zero
  // Held values alone may drive the others: then their first residual is the measure.
  const double scale = b_norm > 0 ? b_norm : std::sqrt(sums.rr);
  const double target = options.tolerance * scale;
  Scalar rz_old = 0;
  while (true) {
    report.residual = sums.rr > 0 ? std::sqrt(sums.rr) / scale : 0;
    report.converged = std::sqrt(sums.rr) <= target;
    if (report.converged || report.iterations >= options.max_iterations || !std::isfinite(sums.rr)) return report;
    preconditioner.next_direction(r, rz_old == Scalar(0) ? Scalar(0) : sums.rz / rz_old, held, p);
    apply(a, p, q);
    const Scalar curvature = dot(p, q);
    report.positive_definite = is_curvature(curvature);
    if (!report.positive_definite || sums.rz == Scalar(0)) return report;  // the recurrences have broken down
    rz_old = sums.rz;
    sums = preconditioner.update(rz_old / curvature, p, q, held, x, r);
    ++report.iterations;
  }
}

/// One solve from a zero guess, for occasional use. Throws Error(Fault::numerics) when it does not converge.
Vector solve_spd(const SparseMatrix& a, const Vector& b, const ConjugateGradientOptions& options = {});

/// Stabilised bi-conjugate gradients (van der Vorst 1992), Jacobi-preconditioned, for a general square matrix; first
/// guess b. Throws Error(Fault::numerics) when it does not converge.
Vector solve_general(const SparseMatrix& a, const Vector& b, double tolerance = 1e-13);

}  // namespace pelage
