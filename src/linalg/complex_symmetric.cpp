#include "linalg/complex_symmetric.h"

#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace pelage {

namespace {

using Complex = std::complex<double>;

/// a b without the operator's detour for infinite factors, which costs more than the product.
Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// x . y, not conjugated.
Complex product(const ComplexVector& x, const ComplexVector& y) {
  return ordered_sum(static_cast<std::size_t>(x.size()), Complex(0), [&](std::size_t begin, std::size_t end) {
    Complex sum = 0;
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) sum += times(x[i], y[i]);
    return sum;
  });
}

double norm(const ComplexVector& x) {
  return std::sqrt(ordered_sum(static_cast<std::size_t>(x.size()), 0.0, [&](std::size_t begin, std::size_t end) {
    return x.segment(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin)).squaredNorm();
  }));
}

struct Sums {
  double rr = 0;   ///< |r|^2
  Complex rz = 0;  ///< r . D^-1 r
  Sums& operator+=(const Sums& other) {
    rr += other.rr;
    rz += other.rz;
    return *this;
  }
};

/// x += alpha p, r -= alpha q, and the sums that the next direction needs.
Sums update(Complex alpha, const ComplexVector& p, const ComplexVector& q, const ComplexVector& inverse_diagonal,
            ComplexVector& x, ComplexVector& r) {
  return ordered_sum(static_cast<std::size_t>(x.size()), Sums{}, [&](std::size_t begin, std::size_t end) {
    Sums sums;
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
      x[i] += times(alpha, p[i]);
      r[i] -= times(alpha, q[i]);
      sums.rr += std::norm(r[i]);
      sums.rz += times(times(r[i], r[i]), inverse_diagonal[i]);
    }
    return sums;
  });
}

/// p = D^-1 r + beta p.
void next_direction(const ComplexVector& r, const ComplexVector& inverse_diagonal, Complex beta, ComplexVector& p) {
  parallel_for(static_cast<std::size_t>(p.size()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i)
      p[i] = times(inverse_diagonal[i], r[i]) + times(beta, p[i]);
  });
}

}  // namespace

void combine(const SparseMatrix& a, Complex t, const SparseMatrix& b, ComplexMatrix& result) {
  assert(a.pattern == b.pattern);
  result.pattern = a.pattern;
  result.value.resize(a.value.size());
  parallel_for(a.value.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) result.value[k] = a.value[k] + t * b.value[k];
  });
}

void apply(const ComplexMatrix& a, const ComplexVector& x, ComplexVector& y) {
  assert(x.size() == a.pattern->columns);
  y.resize(a.pattern->rows);
  const std::int64_t* start = a.pattern->start.data();
  const std::int32_t* column = a.pattern->column.data();
  const Complex* value = a.value.data();
  const Complex* in = x.data();
  Complex* out = y.data();
  auto rows = [=](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      double re = 0, im = 0;
      for (std::int64_t k = start[r]; k < start[r + 1]; ++k) {
        const Complex term = times(value[k], in[column[k]]);
        re += term.real();
        im += term.imag();
      }
      out[r] = {re, im};
    }
  };
  parallel_for(static_cast<std::size_t>(a.pattern->rows), rows, default_chunk / 8);  // as for real matrices
}

SolveReport ComplexConjugateGradient::solve(const ComplexMatrix& a, const ComplexVector& inverse_diagonal,
                                            const ComplexVector& b, ComplexVector& x,
                                            const ConjugateGradientOptions& options) {
  SolveReport report;
  const double b_norm = norm(b);
  if (b_norm == 0) {
    x.setZero(b.size());
    report.converged = true;
    return report;
  }
  if (!std::isfinite(b_norm)) {  // no residual is small or large beside it
    report.residual = b_norm;
    return report;
  }
  apply(a, x, q_);
  r_ = b;
  p_.setZero(b.size());
  Sums sums = update(1, p_, q_, inverse_diagonal, x, r_);  // r = b - A x, as p is zero
  Complex rz_old = 0;
  while (true) {
    report.residual = std::sqrt(sums.rr) / b_norm;
    report.converged = report.residual <= options.tolerance;
    if (report.converged || report.iterations >= options.max_iterations || !std::isfinite(sums.rr)) return report;
    next_direction(r_, inverse_diagonal, rz_old == 0.0 ? 0 : sums.rz / rz_old, p_);
    apply(a, p_, q_);
    const Complex curvature = product(p_, q_);
    if (curvature == 0.0 || sums.rz == 0.0) return report;  // the recurrences have broken down
    rz_old = sums.rz;
    sums = update(rz_old / curvature, p_, q_, inverse_diagonal, x, r_);
    ++report.iterations;
  }
}

}  // namespace pelage
