#pragma once
// Symmetric sparse systems that are made of triangles, with the unknowns of a vertex in a block: solved directly, as
// charts are small and solved for again and again.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// What a triangle adds to the matrix: row and column 2 k + a belong to coordinate a of corner k.
using TriangleBlock = Eigen::Matrix<double, 6, 6>;

/// Positive definite matrices of two unknowns per vertex; unknown 2 v + a.
class BlockSolver {
 public:
  BlockSolver(std::size_t vertices, const std::vector<Triangle>& triangles);
  ~BlockSolver();
  BlockSolver(BlockSolver&&) noexcept;

  void clear();
  void add(std::size_t triangle, const TriangleBlock& block);
  void add_diagonal(std::size_t vertex, double value);
  /// False where the matrix cannot be factorised.
  bool factorise();
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage
