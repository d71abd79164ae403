#pragma once
// Sparse matrices in compressed rows, and the verbs that algorithms are written in. What depends on connectivity (the
// pattern) is shared between matrices; values are refilled. All verbs give the same bits for any number of threads.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace pelage {

using Vector = Eigen::VectorXd;

struct SparsePattern {
  std::int32_t rows = 0, columns = 0;
  std::vector<std::int64_t> start{0};  ///< rows + 1
  std::vector<std::int32_t> column;    ///< ascending in every row

  std::size_t nonzeros() const { return column.size(); }
  /// Position of an entry in `column`, or -1.
  std::int64_t find(std::int32_t row, std::int32_t col) const;
};

struct SparseMatrix {
  std::shared_ptr<const SparsePattern> pattern;
  std::vector<double> value;  ///< one per entry of the pattern

  std::int32_t rows() const { return pattern->rows; }
  std::int32_t columns() const { return pattern->columns; }
};

/// Matrices that are shared never change: one with other values is another object, which is how those who keep
/// something made of it know.
using SharedMatrix = std::shared_ptr<const SparseMatrix>;
using SharedVector = std::shared_ptr<const Vector>;

/// A matrix of zeros.
SparseMatrix zeros(std::shared_ptr<const SparsePattern> pattern);

/// y = A x. y is resized.
void apply(const SparseMatrix& a, const Vector& x, Vector& y);
Vector operator*(const SparseMatrix& a, const Vector& x);

/// The transpose, with a pattern of its own.
SparseMatrix transpose(const SparseMatrix& a);

/// result = alpha A + beta B for matrices that share a pattern; `result` may be A or B.
void combine(double alpha, const SparseMatrix& a, double beta, const SparseMatrix& b, SparseMatrix& result);

Vector diagonal(const SparseMatrix& a);

// Reductions go over fixed chunks in order.

/// x . y.
double dot(const Vector& x, const Vector& y);
/// Euclidean length.
double norm(const Vector& x);
double sum(const Vector& x);
/// Of a vector that is not empty. NaN entries do not take part.
double minimum(const Vector& x);
double maximum(const Vector& x);
/// y = alpha x + beta y.
void axpby(double alpha, const Vector& x, double beta, Vector& y);

}  // namespace pelage
