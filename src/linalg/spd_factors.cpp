#include "linalg/spd_factors.h"

#include <Eigen/SparseCholesky>

#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"

namespace pelage {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

/// The lower triangle; a row of A, which is symmetric, is a column.
Matrix lower_triangle(const SparseMatrix& a) {
  const SparsePattern& p = *a.pattern;
  Matrix result(p.rows, p.rows);
  result.reserve(static_cast<Eigen::Index>(p.nonzeros() / 2) + p.rows);
  for (std::int32_t column = 0; column < p.rows; ++column) {
    result.startVec(column);
    for (auto k = p.start[static_cast<std::size_t>(column)]; k < p.start[static_cast<std::size_t>(column) + 1]; ++k) {
      const std::int32_t row = p.column[static_cast<std::size_t>(k)];
      const double value = a.value[static_cast<std::size_t>(k)];
      if (row >= column) result.insertBack(row, column) = row == column && value == 0 ? 1 : value;
    }
  }
  result.finalize();
  return result;
}

}  // namespace

struct SpdFactors::Parts {
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factors;
};

SpdFactors::SpdFactors(const SparseMatrix& a) : parts_(std::make_unique<Parts>()) {
  parts_->factors.compute(lower_triangle(a));
  if (parts_->factors.info() != Eigen::Success)
    throw Error(Fault::numerics, "a matrix of the surface has no factors; look for triangles without area");
}

SpdFactors::~SpdFactors() = default;

Vector SpdFactors::solve(const Vector& b) const { return parts_->factors.solve(b); }

std::function<Vector(const Vector&)> spd_inverse(const SharedMatrix& a) {
  // Factors take some 4 kB a row at this size, and more beyond; matrices of volumes have more entries and fill up.
  constexpr std::int32_t most_rows = 400'000;
  constexpr std::size_t most_entries = 10;  // in a row
  if (a->rows() <= most_rows && a->pattern->nonzeros() <= most_entries * static_cast<std::size_t>(a->rows()))
    return [factors = std::make_shared<const SpdFactors>(*a)](const Vector& b) { return factors->solve(b); };
  return [a](const Vector& b) { return solve_spd(*a, b, {.tolerance = 1e-8}); };
}

}  // namespace pelage
