#pragma once
// Preconditioned conjugate gradients (Hestenes, Stiefel 1952) for symmetric positive definite systems.

#include "linalg/sparse.h"

namespace pelage {

struct SolveReport {
  int iterations = 0;
  double residual = 0;  ///< |b - A x| / |b|, as updated by the recurrence
  bool converged = false;
  bool positive_definite = true;  ///< false: a direction of non-positive curvature was met, and the solve given up
};

struct ConjugateGradientOptions {
  double tolerance = 1e-10;  ///< on |b - A x| / |b|. A warm start satisfies a loose tolerance without any iteration
                             ///< while a pattern still grows slowly: keep it far below the change of one step.
  int max_iterations = 2000;
};

/// Work vectors, kept between solves of the same size.
class ConjugateGradient {
 public:
  /// Solves A x = b with Jacobi preconditioning; x holds the first guess and the result. Unknowns whose inverse
  /// diagonal is 0 are held: they keep the value of the guess, and their equations do not count.
  SolveReport solve(const SparseMatrix& a, const Vector& inverse_diagonal, const Vector& b, Vector& x,
                    const ConjugateGradientOptions& options = {});

 private:
  Vector r_, p_, q_;
};

/// One solve from a zero guess, for occasional use.
Vector solve_spd(const SparseMatrix& a, const Vector& b, const ConjugateGradientOptions& options = {});

/// Stabilised bi-conjugate gradients (van der Vorst 1992), Jacobi-preconditioned, for a general square matrix; first
/// guess b. Throws Error(Fault::numerics) when it does not converge.
Vector solve_general(const SparseMatrix& a, const Vector& b, double tolerance = 1e-13);

}  // namespace pelage
