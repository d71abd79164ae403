#include <algorithm>
#include <cmath>

#include "time/lattice_step.h"

namespace pelage {

namespace {

/// Rounds of a step at most.
constexpr int most_rounds = 25;
/// On residuals, relative: while rates still jump, and at most for those that seem to have come to rest.
constexpr double first_tolerance = 1e-2, last_tolerance = 1e-6;

/// The steady state of species that decay at constant rates b_i and are made at rates that only jump, as in threshold
/// patterns: rounds of
///   (b_i - div T_i grad) u_i' = N_i(u)
/// until no rate jumps any more, which is a steady state of the equations themselves: the counterpart on any space of
/// the binary convolution of Witkin, Kass 1991, section 5, with an implicit solve for each species instead of a
/// Gaussian. With two species that are made alike the difference of the solutions is a positive form of N, so that
/// rounds cannot alternate. On lattices without matrices the solves are exact, wave by wave. Of a start in which
/// nothing is made yet the fields spread first, in a step of implicit Euler of 1/b_i.
class SignIteration final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override;

 private:
  std::string why_not(const System& system) const;
  void solve(const System& system, double decay_factor, const SolverKind& solver, StepReport& report);
  void solve_wave_by_wave(const System& system, double decay_factor);
  void solve_with_matrices(const System& system, double decay_factor, const SolverKind& solver, StepReport& report);

  LinearParts parts_;
  std::vector<std::size_t> evolving_;
  std::vector<Vector> made_, next_;
  double tolerance_ = 0;  ///< of the solves of this round
  std::vector<StepMatrix> matrices_;
  std::optional<LatticeTransform<double>> transform_;
  std::vector<std::vector<double>> form_;  ///< k . T k of every wave, per species
  std::vector<double> waves_, made_waves_;
};

std::string SignIteration::why_not(const System& system) const {
  if (!system.mass) {
    if (std::string why = why_no_waves(system); !why.empty()) return why;
  } else if (!system.coupled.index.empty() || system.held || system.fluxes) {
    return "it neither couples species by Laplacians nor holds any, and takes no fluxes";
  }
  for (const std::size_t i : evolving_)
    if (!(parts_.c(i) < 0)) return system.species[i].name + " has to decay, at a constant rate";
  return {};
}

void SignIteration::solve_wave_by_wave(const System& system, double decay_factor) {
  if (!transform_) {
    transform_.emplace(*system.lattice);
    waves_.resize(transform_->size());
    made_waves_.resize(transform_->size());
    for (const Species& s : system.species)
      form_.push_back(s.tensor ? transform_->quadratic_form(*s.tensor) : std::vector<double>{});
  }
  for (std::size_t k = 0; k < evolving_.size(); ++k) {
    const std::size_t i = evolving_[k];
    // Species of a pair, and of all pairs, are made alike.
    if (k == 0 || made_[i] != made_[evolving_[k - 1]]) transform_->forward(made_[i].data(), made_waves_.data());
    for_waves(*transform_, [&](std::size_t w, std::size_t n) {
      waves_[n] = made_waves_[n] / (form_[i][w] - decay_factor * parts_.c(i));
    });
    transform_->inverse(waves_.data(), next_[i].data());
  }
}

void SignIteration::solve_with_matrices(const System& system, double decay_factor, const SolverKind& solver,
                                        StepReport& report) {
  matrices_.resize(system.species.size());
  for (const std::size_t i : evolving_) {
    const Species& species = system.species[i];
    const SharedMatrix& mass = mass_of(system, i);
    matrices_[i].update(mass, -decay_factor * parts_.c(i), species.stiffness, species.diffusion, solver);
    const Vector rhs = system.sampling->test * Vector(weight_of(system, i).cwiseProduct(made_[i]));
    matrices_[i].solve(rhs, next_[i], nullptr, species.name, tolerance_, report);
  }
}

void SignIteration::solve(const System& system, double decay_factor, const SolverKind& solver, StepReport& report) {
  if (!system.mass)
    solve_wave_by_wave(system, decay_factor);
  else
    solve_with_matrices(system, decay_factor, solver, report);
}

StepReport SignIteration::step(const System& system, State& state, const StepRequest& request) {
  evolving_ = evolving_species(system);
  parts_.split(system, state.now, state.time);
  if (std::string why = why_not(system); !why.empty()) return refusal(std::move(why));
  StepReport report;
  next_ = state.now;
  made_.resize(next_.size());
  tolerance_ = first_tolerance;
  const bool starts = state.step == 0;
  bool jumps = true;
  for (int round = 0; round < most_rounds && jumps && report.failure.empty(); ++round) {
    const bool spreads = starts && round == 0;
    for (const std::size_t i : evolving_) {
      made_[i] = parts_.rest(i);
      if (spreads) axpby(-parts_.c(i), next_[i], 1, made_[i]);
    }
    solve(system, spreads ? 2 : 1, *request.solver, report);
    parts_.evaluate(system, next_, state.time);
    jumps = spreads || std::ranges::any_of(evolving_, [&](std::size_t i) { return made_[i] != parts_.rest(i); });
    const double last = std::min(last_tolerance, request.solver_tolerance);
    if (!jumps && system.mass && tolerance_ > last) {
      tolerance_ = last;
      jumps = true;
    }
    if (!system.mass) ++report.iterations;
  }
  advance(system, state, request.dt, next_, report);
  return report;
}

}  // namespace

constexpr StepperKind sign_iteration = {
    .name = "sign-iteration",
    .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<SignIteration>(); },
    .matrix_free = true,
    .nodal = true,
    .symmetric = true,
    .solves = true};

}  // namespace pelage
