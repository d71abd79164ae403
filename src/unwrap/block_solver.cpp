#include "unwrap/block_solver.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace pelage {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

std::int32_t unknown(const Triangle& t, int row) { return 2 * t[row / 2] + row % 2; }

/// The lower halves of all blocks.
Matrix pattern_of(std::size_t vertices, const std::vector<Triangle>& triangles) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(21 * triangles.size());
  for (const Triangle& t : triangles)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) {
        const auto [low, high] = std::minmax({unknown(t, i), unknown(t, j)});
        entries.emplace_back(high, low, 0.0);
      }
  const auto n = static_cast<Eigen::Index>(2 * vertices);
  Matrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

std::int32_t position(const Matrix& a, std::int32_t row, std::int32_t column) {
  const auto* begin = a.innerIndexPtr() + a.outerIndexPtr()[column];
  const auto* end = a.innerIndexPtr() + a.outerIndexPtr()[column + 1];
  return static_cast<std::int32_t>(std::lower_bound(begin, end, row) - a.innerIndexPtr());
}

}  // namespace

struct BlockSolver::Parts {
  Matrix matrix;
  std::vector<std::array<std::int32_t, 21>> place;  ///< per triangle: of its entries among the values
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver;
  bool analysed = false;
};

BlockSolver::BlockSolver(std::size_t vertices, const std::vector<Triangle>& triangles)
    : parts_(std::make_unique<Parts>()) {
  parts_->matrix = pattern_of(vertices, triangles);
  for (const Triangle& t : triangles) {
    auto place = parts_->place.emplace_back().begin();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) {
        const auto [low, high] = std::minmax({unknown(t, i), unknown(t, j)});
        *place++ = position(parts_->matrix, high, low);
      }
  }
}
BlockSolver::~BlockSolver() = default;
BlockSolver::BlockSolver(BlockSolver&&) noexcept = default;

void BlockSolver::clear() { parts_->matrix.coeffs().setZero(); }

void BlockSolver::add(std::size_t triangle, const TriangleBlock& block) {
  double* values = parts_->matrix.valuePtr();
  auto place = parts_->place[triangle].begin();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) values[*place++] += block(i, j);
}

void BlockSolver::add_diagonal(std::size_t vertex, double value) {
  for (std::size_t u = 2 * vertex; u < 2 * vertex + 2; ++u)
    parts_->matrix.valuePtr()[parts_->matrix.outerIndexPtr()[u]] += value;
}

bool BlockSolver::factorise() {
  if (!parts_->analysed) parts_->solver.analyzePattern(parts_->matrix);
  parts_->analysed = true;
  parts_->solver.factorize(parts_->matrix);
  return parts_->solver.info() == Eigen::Success;
}

Eigen::VectorXd BlockSolver::solve(const Eigen::VectorXd& b) const { return parts_->solver.solve(b); }

}  // namespace pelage
