#pragma once
// A preconditioner for matrices in which the mass matrix of smooth elements prevails.

#include <optional>

#include "linalg/sparse.h"

namespace pelage {

/// The basis functions at the vertices, A, with M = A' W A and W diagonal.
struct VertexBasis {
  const SparseMatrix* values = nullptr;      ///< A; null: there is no such form, or A = I
  const SparseMatrix* transposed = nullptr;  ///< A'
};

/// A damps the finest waves, that of Loop elements to a quarter, which makes M ill-conditioned. P = I + G (I - A)
/// brings them back, so that P D^-1 P' comes closer to the inverse of M + t K than Jacobi's D^-1 does.
struct Sharpening {
  VertexBasis basis;
  Vector strength;  ///< the diagonal of G, not negative
};

/// For alpha M + beta K by the diagonals of alpha M and of the sum; nothing where Jacobi's preconditioner is better.
std::optional<Sharpening> make_sharpening(const VertexBasis& basis, const Vector& mass_diagonal,
                                          const Vector& diagonal);

/// z = P D^-1 P' r, but 0 where D^-1 is; returns r . z. t is work space.
double sharpen(const Sharpening& sharpening, const Vector& inverse_diagonal, const Vector& r, Vector& t, Vector& z);

}  // namespace pelage
