#include <algorithm>

#include "base/dense.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// u^(n+1) = u^n + dt M^-1 (-K u^n + load(R^n)). The mass matrix of Loop elements is not diagonal, so even this scheme
/// solves a system; row-sum lumping, which would avoid it, is wrong for Loop elements.
class ForwardEuler final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override {
    sample_fields(system, state.now, samples_);
    evaluate_rates(system, samples_, state.time, rates_);
    const std::vector<Vector> fluxes = system.fluxes ? system.fluxes(state.now, state.time) : std::vector<Vector>{};
    StepReport report;
    next_.resize(system.species.size());
    own_mass_.resize(system.species.size());
    for (std::size_t i = 0; i < system.species.size(); ++i) {
      const Species& species = system.species[i];
      next_[i] = state.now[i];
      if (species.algebraic) continue;
      StepMatrix& mass = species.mass ? own_mass_[i] : mass_;
      mass.update(mass_of(system, i), 1, species.stiffness, 0, *request.solver);
      rhs_ = system.sampling->test * Vector(weight_of(system, i).cwiseProduct(rates_[i]));
      add_flux(fluxes, i, 1, rhs_);
      if (species.coupled) {
        subtract_fluxes(system, state, i);
      } else {
        apply(*species.stiffness, state.now[i], flux_);
        axpby(-species.diffusion, flux_, 1, rhs_);
      }
      slope_.setZero(rhs_.size());
      if (system.set_values) {
        given_ = state.now[i];
        system.set_values(i, state.time + request.dt, given_);
        slope_ = (given_ - state.now[i]) / request.dt;
      }
      mass.solve(rhs_, slope_, held_of(system, i), species.name, request.solver_tolerance, report);
      axpby(request.dt, slope_, 1, next_[i]);
    }
    if (!system.coupled.index.empty())
      solve_noted(coupled_names(system), report,
                  [&] { return solve_algebraic(system, state.time + request.dt, next_, request.solver_tolerance); });
    advance(system, state, request.dt, next_, report);
    return report;
  }

 private:
  /// rhs_ -= sum_j D_ij K u_j.
  void subtract_fluxes(const System& system, const State& state, std::size_t i) {
    const CoupledSpecies& c = system.coupled;
    const auto row = std::ranges::find(c.index, i) - c.index.begin();
    for (std::size_t k = 0; k < c.index.size(); ++k) {
      const double d = c.diffusion(row, static_cast<Eigen::Index>(k));
      if (d == 0) continue;
      apply(*c.stiffness, state.now[c.index[k]], flux_);
      axpby(-d, flux_, 1, rhs_);
    }
  }

  StepMatrix mass_;  ///< of all species but those with a varying C0
  std::vector<StepMatrix> own_mass_;
  std::vector<Vector> samples_, rates_, next_;
  Vector rhs_, flux_, slope_, given_;
};

/// Algebraic species follow without delay.
Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  const Eigen::MatrixXd evolving = l.evolving.asDiagonal();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(decay.rows(), decay.rows());
  // Rows of algebraic species: (1 + mu D) w' = (dR/du) u', all taken at the new time.
  const Eigen::MatrixXd follow = one - (one - evolving) * (one + l.jacobian - decay);
  return solved(follow, evolving * (one + dt * (l.jacobian - decay)));
}

}  // namespace

constexpr StepperKind explicit_euler = {
    .name = "explicit",
    .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<ForwardEuler>(); },
    .couples = true,
    .holds = true,
    .amplification = amplification,
    .gives_values = true,
    .solves = true};

}  // namespace pelage
