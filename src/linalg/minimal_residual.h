#pragma once
// Minimal residuals (MINRES; Paige, Saunders 1975) for real symmetric systems that need not be positive definite.

#include "linalg/conjugate_gradient.h"

namespace pelage {

/// Solves A x = b as conjugate_gradient() does, preconditioned by the magnitudes of the diagonal. x holds the first
/// guess and the result. Equations of held unknowns do not count.
SolveReport minimal_residuals(const SparseMatrix& a, const Vector& b, Vector& x, const Held* held,
                              const ConjugateGradientOptions& options);

}  // namespace pelage
