#pragma once
// Who solves the symmetric systems of implicit steps, which are positive definite unless the step is too large:
// conjugate gradients, and what papers on fitted grids take instead, to be compared with them.

#include <memory>
#include <span>
#include <string_view>

#include "linalg/conjugate_gradient.h"

namespace pelage {

/// Solves with one matrix after the other.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Prepares for a matrix, which has to stay as it is while it is solved with.
  virtual void update(const SparseMatrix& matrix) = 0;
  /// x holds the first guess and the result. Equations of held unknowns do not count. Relative `tolerance` on |b - A
  /// x|. May converge though the report says that the matrix is not positive definite.
  virtual SolveReport solve(const Vector& b, Vector& x, const Held* held, double tolerance) = 0;
};

/// What the rest of the program knows of a solver.
struct SolverKind {
  std::string_view name;
  std::string_view summary;  ///< some words
  std::unique_ptr<LinearSolver> (*make)();
};

extern const SolverKind jacobi_gradients;  ///< conjugate gradients with the diagonal as preconditioner
extern const SolverKind plain_gradients;   ///< the same without one
extern const SolverKind coloured_sweeps;   ///< SOR by colours, see linalg/sor.h: red and black where two are enough
extern const SolverKind sweeps_in_order;   ///< SOR in the order of the unknowns

/// The default first.
std::span<const SolverKind* const> solver_kinds();

}  // namespace pelage
