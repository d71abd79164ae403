#pragma once
// Discrete harmonic functions.

#include "linalg/conjugate_gradient.h"

namespace pelage {

/// Functions u with K u = 0 at all unknowns that are not held, K a stiffness matrix: without sources and fluxes.
class HarmonicFunctions {
 public:
  HarmonicFunctions(SharedMatrix stiffness, Held held);

  /// Keeps the values of `u` where it is held and fills in the others, for which they are the first guess. `tolerance`:
  /// of the residual beside that of the guess. Error(Fault::numerics) where the iteration does not converge.
  void complete(Vector& u, double tolerance) const;
  const Held& held() const { return held_; }

 private:
  SharedMatrix stiffness_;
  Held held_;
  Jacobi<Vector> preconditioner_;
};

}  // namespace pelage
