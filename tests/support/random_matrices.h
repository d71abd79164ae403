#pragma once
// Sparse matrices with random entries, and their dense copies.

#include <Eigen/Core>
#include <memory>

#include "base/random.h"
#include "linalg/sparse.h"

namespace pelage::testing {

inline Eigen::MatrixXd dense(const SparseMatrix& a) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(a.rows(), a.columns());
  for (std::int32_t r = 0; r < a.rows(); ++r)
    for (auto k = a.pattern->start[static_cast<std::size_t>(r)]; k < a.pattern->start[static_cast<std::size_t>(r) + 1];
         ++k)
      d(r, a.pattern->column[static_cast<std::size_t>(k)]) += a.value[static_cast<std::size_t>(k)];
  return d;
}

/// Entries in [-1/2, 1/2), about `per_row` of them in every row.
inline SparseMatrix random_matrix(std::int32_t rows, std::int32_t columns, double per_row, std::uint64_t seed) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = rows;
  pattern->columns = columns;
  SparseMatrix a;
  for (std::int32_t r = 0; r < rows; ++r) {
    for (std::int32_t c = 0; c < columns; ++c) {
      const auto key =
          static_cast<std::uint64_t>(r) * static_cast<std::uint64_t>(columns) + static_cast<std::uint64_t>(c);
      if (uniform(seed, key) * columns >= per_row) continue;
      pattern->column.push_back(c);
      a.value.push_back(uniform(seed + 1, key) - 0.5);
    }
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  a.pattern = std::move(pattern);
  return a;
}

inline Vector random_vector(Eigen::Index n, std::uint64_t seed) {
  Vector x(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = uniform(seed, static_cast<std::uint64_t>(i)) - 0.5;
  return x;
}

/// The matrix -1, `centre`, -1 of a chain: positive definite for centre > 2, indefinite for 0 < centre < 2.
inline SparseMatrix chain(std::int32_t n, double centre) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  SparseMatrix a;
  for (std::int32_t r = 0; r < n; ++r) {
    for (std::int32_t c = std::max(0, r - 1); c <= std::min(n - 1, r + 1); ++c) {
      pattern->column.push_back(c);
      a.value.push_back(r == c ? centre : -1);
    }
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  a.pattern = std::move(pattern);
  return a;
}

}  // namespace pelage::testing
