#pragma once
// Symmetric positive definite matrices of surfaces, factored: many solves with one, and ones that conjugate gradients
// are slow with, because the mesh has slivers.

#include <functional>
#include <memory>

#include "linalg/sparse.h"

namespace pelage {

class SpdFactors {
 public:
  /// A = L D L', its unknowns in an order of little fill (Amestoy, Davis, Duff 1996). Rows of zeros count as rows of
  /// the identity. Error(Fault::numerics) for a matrix that has no factors.
  explicit SpdFactors(const SparseMatrix& a);
  ~SpdFactors();
  SpdFactors(const SpdFactors&) = delete;
  SpdFactors& operator=(const SpdFactors&) = delete;

  /// x with A x = b.
  Vector solve(const Vector& b) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// x -> A^-1 x, to 1e-8: by factors where these have room, which slivers do not trouble, else by conjugate gradients.
/// Error(Fault::numerics) where neither does it.
std::function<Vector(const Vector&)> spd_inverse(const SharedMatrix& a);

}  // namespace pelage
