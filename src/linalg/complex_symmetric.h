#pragma once
// Complex symmetric sparse systems, A = A' without conjugation: what a pair of coupled fields becomes in the complex
// plane.

#include <complex>

#include "linalg/conjugate_gradient.h"

namespace pelage {

using ComplexVector = Eigen::VectorXcd;

struct ComplexMatrix {
  std::shared_ptr<const SparsePattern> pattern;
  std::vector<std::complex<double>> value;  ///< one per entry of the pattern
};

/// result = A + t B for matrices that share a pattern.
void combine(const SparseMatrix& a, std::complex<double> t, const SparseMatrix& b, ComplexMatrix& result);

/// y = A x. y is resized.
void apply(const ComplexMatrix& a, const ComplexVector& x, ComplexVector& y);

/// Conjugate orthogonal conjugate gradients (van der Vorst, Melissen 1990): the recurrences of conjugate gradients with
/// the product x . y in which nothing is conjugated. Work vectors are kept between solves of the same size.
class ComplexConjugateGradient {
 public:
  /// Solves A x = b with Jacobi preconditioning; x holds the first guess and the result.
  SolveReport solve(const ComplexMatrix& a, const ComplexVector& inverse_diagonal, const ComplexVector& b,
                    ComplexVector& x, const ConjugateGradientOptions& options = {});

 private:
  ComplexVector r_, p_, q_;
};

}  // namespace pelage
