#pragma once
// What all steppers share.

#include "linalg/coupled_solver.h"
#include "time/stepper.h"

namespace pelage {

/// Fields at the samples, and products of gradients behind them.
void sample_fields(const System& system, const std::vector<Vector>& coefficients, std::vector<Vector>& samples);

/// Reaction rates at the samples.
void evaluate_rates(const System& system, const std::vector<Vector>& samples, double t, std::vector<Vector>& rates);

/// Adds `factor` times the flux of a species to its right-hand side, if it has one.
void add_flux(const std::vector<Vector>& fluxes, std::size_t species, double factor, Vector& rhs);

/// Replaces the coefficients of the species that Species::follows by those that the others determine at time t.
void follow(const System& system, double t, std::vector<Vector>& coefficients);

/// Replaces the coefficients of coupled algebraic species by those that the evolving ones determine at time t.
SolveReport solve_algebraic(const System& system, double t, std::vector<Vector>& coefficients, double tolerance);

/// Root mean square of the coefficients below which differences of a species count for nothing, so that one that decays
/// is at rest in the end. No amount of matter is so small in any unit, and its squares are far from the smallest
/// numbers.
inline constexpr double negligible = 1e-80;

/// Moves the state to `next` (applying the clamps) unless it is not finite, and fills in change, minimum and maximum. A
/// species that lies far below `negligible` everywhere is 0 from then on: solvers cannot square smaller numbers.
void advance(const System& system, State& state, double dt, std::vector<Vector>& next, StepReport& report);

/// alpha M + beta K_i for one species, kept while alpha, beta, the matrices and the solver stay the same.
class StepMatrix {
 public:
  void update(const SharedMatrix& mass, double alpha, const SharedMatrix& stiffness, double beta,
              const SolverKind& solver = jacobi_gradients);
  /// Solves for one right-hand side; x holds the first guess, which `held` unknowns keep.
  void solve(const Vector& b, Vector& x, const Held* held, const std::string& species, double tolerance,
             StepReport& report);

 private:
  SharedMatrix mass_, stiffness_;
  double alpha_ = 0, beta_ = 0;
  std::unique_ptr<SparseMatrix> matrix_;  ///< at a place of its own, which the solver knows
  const SolverKind* kind_ = nullptr;
  std::unique_ptr<LinearSolver> solver_;
};

/// Notes iterations, residual, seconds and failure of a solve in the report; `names`: of the species that are solved
/// for.
void solve_noted(const std::string& names, StepReport& report, const std::function<SolveReport()>& solve);
/// What a stepper answers that cannot grow a system.
StepReport refusal(std::string why);
/// Makes it the failure of the step.
void note_runaway(const Runaway& runaway, StepReport& report);
std::string coupled_names(const System& system);

}  // namespace pelage
