#pragma once
// Complex symmetric sparse matrices, A = A' without conjugation: what a pair of coupled fields becomes in the complex
// plane. The verbs are those of real matrices; no product conjugates anything.

#include <complex>

#include "linalg/sparse.h"

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

/// x . y, not conjugated.
std::complex<double> dot(const ComplexVector& x, const ComplexVector& y);
/// Euclidean length.
double norm(const ComplexVector& x);

/// a b without the operator's detour for infinite factors, which costs more than the product.
inline std::complex<double> times(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
inline double times(double a, double b) { return a * b; }

inline double square_of_magnitude(std::complex<double> a) { return std::norm(a); }
inline double square_of_magnitude(double a) { return a * a; }

/// Whether p . A p can be divided by: positive for a positive definite A, not 0 for a complex one.
inline bool is_curvature(std::complex<double> c) { return c != 0.0; }
inline bool is_curvature(double c) { return c > 0; }

}  // namespace pelage
