#include "linalg/linear_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "linalg/minimal_residual.h"
#include "linalg/sor.h"

namespace pelage {

namespace {

/// By minimal residuals where conjugate gradients find that a matrix is not positive definite.
template <bool preconditioned>
class GradientSolver final : public LinearSolver {
 public:
  void update(const SparseMatrix& matrix) override {
    matrix_ = &matrix;
    preconditioner_ = Jacobi<Vector>(preconditioned ? diagonal(matrix) : Vector(Vector::Ones(matrix.rows())));
  }
  SolveReport solve(const Vector& b, Vector& x, const Held* held, double tolerance) override {
    guess_ = x;
    const SolveReport first =
        conjugate_gradient(*matrix_, preconditioner_, b, x, held, {.tolerance = tolerance}, work_);
    if (first.positive_definite) return first;
    x = guess_;
    SolveReport report = minimal_residuals(*matrix_, b, x, held, {.tolerance = tolerance});
    report.iterations += first.iterations;
    report.positive_definite = false;
    return report;
  }

 private:
  const SparseMatrix* matrix_ = nullptr;
  Jacobi<Vector> preconditioner_;
  ConjugateGradientWork<Vector> work_;
  Vector guess_;
};

/// Young's best factor 2 / (1 + sqrt(1 - mu^2)) for the slowest mode of Jacobi's iteration, which takes mu of it to the
/// next round. In the matrices of steps, a mass and a stiffness that knows no constants, that mode is nearly a
/// constant: 1 - mu is the sum of all entries over that of the diagonal.
double best_relaxation(const SparseMatrix& a) {
  constexpr double most = 1.98;
  const double share = sum(a * Vector(Vector::Ones(a.columns()))) / sum(diagonal(a));
  if (!(share < 1)) return 1;
  return share > 0 ? std::min(most, 2 / (1 + std::sqrt(share * (2 - share)))) : most;
}

template <bool by_colours>
class RelaxationSolver final : public LinearSolver {
 public:
  void update(const SparseMatrix& matrix) override {
    matrix_ = &matrix;
    relaxation_ = best_relaxation(matrix);
    if (pattern_ == matrix.pattern) return;
    pattern_ = matrix.pattern;
    order_ = by_colours ? SweepColours(*pattern_) : SweepColours::lexicographic(*pattern_);
  }
  SolveReport solve(const Vector& b, Vector& x, const Held* held, double tolerance) override {
    return successive_over_relaxation(*matrix_, *order_, b, x, held,
                                      {.relaxation = relaxation_, .tolerance = tolerance});
  }

 private:
  const SparseMatrix* matrix_ = nullptr;
  double relaxation_ = 1;
  std::shared_ptr<const SparsePattern> pattern_;  ///< whose colours these are
  std::optional<SweepColours> order_;
};

template <class Solver>
std::unique_ptr<LinearSolver> make() {
  return std::make_unique<Solver>();
}

}  // namespace

constexpr SolverKind jacobi_gradients = {"jacobi-cg", "conjugate gradients, preconditioned by the diagonal",
                                         make<GradientSolver<true>>};
constexpr SolverKind plain_gradients = {"cg", "conjugate gradients", make<GradientSolver<false>>};
constexpr SolverKind coloured_sweeps = {"red-black", "successive over-relaxation, colour by colour",
                                        make<RelaxationSolver<true>>};
constexpr SolverKind sweeps_in_order = {"sor", "successive over-relaxation, in order", make<RelaxationSolver<false>>};

std::span<const SolverKind* const> solver_kinds() {
  static constexpr const SolverKind* kinds[] = {&jacobi_gradients, &plain_gradients, &coloured_sweeps,
                                                &sweeps_in_order};
  return kinds;
}

}  // namespace pelage
