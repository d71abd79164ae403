#include "linalg/sparse.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace pelage {

std::int64_t SparsePattern::find(std::int32_t row, std::int32_t col) const {
  const auto begin = column.begin() + start[static_cast<std::size_t>(row)];
  const auto end = column.begin() + start[static_cast<std::size_t>(row) + 1];
  const auto it = std::lower_bound(begin, end, col);
  return it != end && *it == col ? it - column.begin() : -1;
}

SparseMatrix zeros(std::shared_ptr<const SparsePattern> pattern) {
  std::vector<double> value(pattern->nonzeros(), 0.0);
  return {std::move(pattern), std::move(value)};
}

void apply(const SparseMatrix& a, const Vector& x, Vector& y) {
  assert(x.size() == a.columns());
  y.resize(a.rows());
  const std::int64_t* start = a.pattern->start.data();
  const std::int32_t* column = a.pattern->column.data();
  const double* value = a.value.data();
  const double* in = x.data();
  double* out = y.data();
  auto rows = [=](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      // Two sums, because one alone waits for the latency of each addition.
      double even = 0, odd = 0;
      std::int64_t k = start[r];
      const std::int64_t stop = start[r + 1];
      for (; k + 1 < stop; k += 2) {
        even += value[k] * in[column[k]];
        odd += value[k + 1] * in[column[k + 1]];
      }
      if (k < stop) even += value[k] * in[column[k]];
      out[r] = even + odd;
    }
  };
  // A row of a Loop matrix costs some forty times as much as an entry of a vector.
  parallel_for(static_cast<std::size_t>(a.rows()), rows, default_chunk / 8);
}

Vector operator*(const SparseMatrix& a, const Vector& x) {
  Vector y;
  apply(a, x, y);
  return y;
}

SparseMatrix transpose(const SparseMatrix& a) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = a.columns();
  pattern->columns = a.rows();
  pattern->start.assign(static_cast<std::size_t>(a.columns()) + 1, 0);
  for (std::int32_t c : a.pattern->column) ++pattern->start[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 1; c < pattern->start.size(); ++c) pattern->start[c] += pattern->start[c - 1];
  pattern->column.resize(a.pattern->nonzeros());
  std::vector<double> value(a.pattern->nonzeros());
  std::vector<std::int64_t> cursor(pattern->start.begin(), pattern->start.end() - 1);
  for (std::int32_t r = 0; r < a.rows(); ++r)
    for (auto k = a.pattern->start[static_cast<std::size_t>(r)]; k < a.pattern->start[static_cast<std::size_t>(r) + 1];
         ++k) {
      const auto position =
          static_cast<std::size_t>(cursor[static_cast<std::size_t>(a.pattern->column[static_cast<std::size_t>(k)])]++);
      pattern->column[position] = r;
      value[position] = a.value[static_cast<std::size_t>(k)];
    }
  return {std::move(pattern), std::move(value)};
}

void combine(double alpha, const SparseMatrix& a, double beta, const SparseMatrix& b, SparseMatrix& result) {
  assert(a.pattern == b.pattern);
  result.pattern = a.pattern;
  result.value.resize(a.value.size());
  parallel_for(a.value.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) result.value[k] = alpha * a.value[k] + beta * b.value[k];
  });
}

Vector diagonal(const SparseMatrix& a) {
  Vector d(a.rows());
  for (std::int32_t r = 0; r < a.rows(); ++r) {
    const std::int64_t k = a.pattern->find(r, r);
    d[r] = k < 0 ? 0 : a.value[static_cast<std::size_t>(k)];
  }
  return d;
}

double dot(const Vector& x, const Vector& y) {
  return ordered_sum(static_cast<std::size_t>(x.size()), 0.0, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return x.segment(first, count).dot(y.segment(first, count));
  });
}

double norm(const Vector& x) { return std::sqrt(dot(x, x)); }

double sum(const Vector& x) {
  return ordered_sum(static_cast<std::size_t>(x.size()), 0.0, [&](std::size_t begin, std::size_t end) {
    double part = 0;
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) part += x[i];
    return part;
  });
}

double minimum(const Vector& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const double value : x) least = std::min(least, value);
  return least;
}

double maximum(const Vector& x) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double value : x) largest = std::max(largest, value);
  return largest;
}

void axpby(double alpha, const Vector& x, double beta, Vector& y) {
  parallel_for(static_cast<std::size_t>(x.size()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i)
      y[i] = alpha * x[i] + beta * y[i];
  });
}

}  // namespace pelage
