#include <deque>

#include "base/dense.h"
#include "base/parallel.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// Eqs. (5)-(8) of Bajaj, Zhang, Xu 2008, which (14)-(15) spell out for the Turing system:
///   (M - dt M[C2(u^n)] + dt K) u^(n+1) = M u^n + dt load(C3(u^n))
/// with M, M[C2] and the load divided by C0 where it varies, and
/// every coefficient taken at step n, also for the species solved second. (The L_ij printed below (14) and (15)
/// have two signs exchanged; the weak forms (14), (15) and eq. (10) agree with this.)
/// Matrices that are kept for some steps have the C2 of an earlier one, the difference goes to the right: C3(u^n) +
/// (C2(u^n) - C2) u^n in place of C3(u^n), which is of first order, too, and has the same states at rest.
class SemiImplicitEuler final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override {
    const double dt = request.dt;
    if (!system.coupled.index.empty() || system.held)
      return refusal("it neither couples species by Laplacians nor holds any");
    StepReport report;
    sample_fields(system, state.now, samples_);
    split(system, state.time);
    next_ = state.now;
    const bool renews = request.refresh == 1 || state.past_rates.empty() || state.step % request.refresh == 0;
    const std::vector<Vector>& kept = renews ? c2_ : state.past_rates;
    kept_.resize(system.species.size());
    const std::vector<Vector> fluxes = system.fluxes ? system.fluxes(state.now, state.time) : std::vector<Vector>{};
    for (std::size_t i = 0; i < system.species.size() && report.failure.empty(); ++i) {
      const Species& species = system.species[i];
      if (species.follows) continue;
      const Vector over_c0 = weight_of(system, i).cwiseQuotient(system.sampling->weight);
      if (renews || !kept_[i].serves(system, i, request))
        kept_[i].make(system, i, request, system.weighted_mass(kept[i].cwiseProduct(over_c0)));
      if (!renews) c3_[i] += (c2_[i] - kept[i]).cwiseProduct(samples_[i]);
      Vector b = *mass_of(system, i) * state.now[i] + dt * load(*system.sampling, c3_[i].cwiseProduct(over_c0));
      add_flux(fluxes, i, dt, b);
      solve_noted(species.name, report,
                  [&] { return kept_[i].solver->solve(b, next_[i], nullptr, request.solver_tolerance); });
    }
    advance(system, state, dt, next_, report);
    if (report.accepted && request.refresh > 1 && renews) state.past_rates = c2_;
    return report;
  }

 private:
  /// M - dt M[C2] + dt K of a species, and what it was made of.
  struct Kept {
    SparseMatrix matrix;
    SharedMatrix mass, stiffness;
    double dt = 0;
    const SolverKind* kind = nullptr;
    std::unique_ptr<LinearSolver> solver;

    bool serves(const System& system, std::size_t i, const StepRequest& request) const {
      return mass == mass_of(system, i) && stiffness == system.species[i].stiffness && dt == request.dt &&
             kind == request.solver;
    }
    void make(const System& system, std::size_t i, const StepRequest& request, const SparseMatrix& reaction) {
      mass = mass_of(system, i);
      stiffness = system.species[i].stiffness;
      dt = request.dt;
      combine(1, *mass, -dt, reaction, matrix);
      combine(1, matrix, dt * system.species[i].diffusion, *stiffness, matrix);
      if (kind != request.solver) solver = request.solver->make();
      kind = request.solver;
      solver->update(matrix);
    }
  };

  void split(const System& system, double t) {
    FieldPointers u;
    MutableFieldPointers c2, c3;
    for (const Vector& field : samples_) u.push_back(field.data());
    c2_.resize(system.species.size());
    c3_.resize(system.species.size());
    for (std::size_t i = 0; i < c2_.size(); ++i) {
      c2_[i].resize(system.sampling->count());
      c3_[i].resize(system.sampling->count());
      c2.push_back(c2_[i].data());
      c3.push_back(c3_[i].data());
    }
    parallel_for(static_cast<std::size_t>(system.sampling->count()),
                 [&](std::size_t begin, std::size_t end) { system.reaction.split(u, t, begin, end, c2, c3); });
  }

  std::deque<Kept> kept_;  ///< which stay in their places: solvers know the matrices
  std::vector<Vector> samples_, c2_, c3_, next_;
};

Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(decay.rows(), decay.rows());
  const Eigen::MatrixXd c2 = l.c2.asDiagonal();
  return solved(one - dt * c2 + dt * decay, one + dt * (l.jacobian - c2));
}

}  // namespace

constexpr StepperKind semi_implicit = {
    .name = "semi-implicit",
    .alias = "paper",
    .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<SemiImplicitEuler>(); },
    .samples = SampleRule::quadrature,
    .amplification = amplification,
    .symmetric = true,
    .solves = true,
    .refreshes = true,
    .splits = true};

}  // namespace pelage
