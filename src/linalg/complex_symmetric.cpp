#include "linalg/complex_symmetric.h"

#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace pelage {

namespace {

using Complex = std::complex<double>;

}  // namespace

Complex dot(const ComplexVector& x, const ComplexVector& y) {
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

}  // namespace pelage
