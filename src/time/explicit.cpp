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
    StepReport report;
    next_.resize(system.species.size());
    for (std::size_t i = 0; i < system.species.size(); ++i) {
      const Species& species = system.species[i];
      mass_.update(*system.mass, 1, *species.stiffness, 0);
      rhs_ = load(*system.sampling, rates_[i]);
      apply(*species.stiffness, state.now[i], flux_);
      axpby(-species.diffusion, flux_, 1, rhs_);
      slope_.setZero(rhs_.size());
      mass_.solve(rhs_, slope_, species.name, request.solver_tolerance, report);
      next_[i] = state.now[i];
      axpby(request.dt, slope_, 1, next_[i]);
    }
    advance(system, state, request.dt, next_, report);
    return report;
  }

 private:
  StepMatrix mass_;
  std::vector<Vector> samples_, rates_, next_;
  Vector rhs_, flux_, slope_;
};

}  // namespace

std::unique_ptr<Stepper> make_explicit() { return std::make_unique<ForwardEuler>(); }

}  // namespace pelage
