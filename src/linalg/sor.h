#pragma once
// Successive over-relaxation (Young 1954), as papers on fitted grids solve their equations: to compare conjugate
// gradients with.

#include <vector>

#include "linalg/conjugate_gradient.h"

namespace pelage {

struct SorOptions {
  double relaxation = 1.5;   ///< 0 < w < 2, which suits symmetric positive definite matrices; 1: Gauss, Seidel
  double tolerance = 1e-10;  ///< on |b - A x| / |b|
  int max_iterations = 10000;
};

/// Unknowns of one colour are not linked, and are relaxed at once: the five-point stencil has two colours (red and
/// black), those of all eight neighbours four.
class SweepColours {
 public:
  /// Every row takes the first colour that none of its neighbours before it has.
  explicit SweepColours(const SparsePattern& pattern);
  /// One after the other as they are numbered.
  static SweepColours lexicographic(const SparsePattern& pattern);

  std::size_t count() const { return colours_.size(); }
  const std::vector<std::int32_t>& rows(std::size_t colour) const { return colours_[colour]; }
  /// Whether the rows of a colour depend on each other, so that their order counts.
  bool in_order() const { return in_order_; }

 private:
  SweepColours() = default;
  std::vector<std::vector<std::int32_t>> colours_;
  bool in_order_ = false;
};

/// Solves A x = b for a matrix with a positive diagonal; x holds the first guess and the result. Equations of held
/// unknowns do not count. The residual is taken once in ten sweeps.
SolveReport successive_over_relaxation(const SparseMatrix& a, const SweepColours& colours, const Vector& b, Vector& x,
                                       const Held* held, const SorOptions& options = {});

}  // namespace pelage
