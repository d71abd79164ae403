#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/parallel.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// All Laplacians implicit, reaction extrapolated. With omega = dt / (previous dt):
///   (1+2w)/(1+w) M u^(n+1) + dt K u^(n+1)
///       = M ((1+w) u^n - w^2/(1+w) u^(n-1)) + dt load((1+w) R^n - w R^(n-1))
/// The first step is semi-implicit Euler; its one local error of second order does not spoil the order. Coupled species
/// have sum_j D_ij K u_j^(n+1) and are solved for together; algebraic ones have
///   M u_i^(n+1) + sum_j D_ij K u_j^(n+1) = load((1+w) R_i^n - w R_i^(n-1)).
class Sbdf2 final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override;

 private:
  /// alpha M u^(n+1) = load of now u^n + before u^(n-1) + rate_now R^n + rate_before R^(n-1), less dt times the fluxes.
  struct Scheme {
    double alpha, now, before, rate_now, rate_before;
  };
  static Scheme scheme(const State& state, double dt);
  void solve_coupled(const System& system, const State& state, const Scheme& s, const StepRequest& request,
                     StepReport& report);
  static void extrapolate(const State& state, std::size_t species, double dt, Vector& guess);
  void first_guess(const System& system, const State& state, std::size_t species, double dt);
  void right_hand_side(const System& system, const Scheme& s, std::size_t species);
  static double early_error(const System& system, const State& state, const std::vector<Vector>& next);
  static double error_estimate(const System& system, const State& state, const std::vector<Vector>& next, double dt);

  std::vector<StepMatrix> matrices_;
  CoupledSolver coupled_;
  void sample(const System& system, const State& state);

  std::vector<Vector> samples_, samples_before_, rates_, rates_before_, fluxes_, fluxes_before_, next_;
  Vector combined_, rhs_;
  // What samples_ are of.
  std::shared_ptr<const Sampling> sampled_by_;
  std::int64_t sampled_at_ = -1;
};

/// Sum of the squares of a field that is negligible.
double negligible_square(const Vector& field) { return static_cast<double>(field.size()) * negligible * negligible; }

Sbdf2::Scheme Sbdf2::scheme(const State& state, double dt) {
  if (state.past.empty()) return {1, 1, 0, dt, 0};
  const double w = dt / state.past_steps[0];
  return {(1 + 2 * w) / (1 + w), 1 + w, -w * w / (1 + w), dt * (1 + w), dt * -w};
}

/// rhs_ = A'W (s.now u^n + s.before u^(n-1) + s.rate_now R^n + s.rate_before R^(n-1)), all at the samples, because
/// M u = A'W (A u); and the fluxes, which are loads already.
void Sbdf2::right_hand_side(const System& system, const Scheme& s, std::size_t i) {
  const Vector& weight = weight_of(system, i);
  combined_.resize(weight.size());
  const bool first = s.rate_before == 0;
  parallel_for(static_cast<std::size_t>(weight.size()), [&](std::size_t begin, std::size_t end) {
    for (auto k = static_cast<Eigen::Index>(begin); k < static_cast<Eigen::Index>(end); ++k) {
      double sum = s.now * samples_[i][k] + s.rate_now * rates_[i][k];
      if (!first) sum += s.before * samples_before_[i][k] + s.rate_before * rates_before_[i][k];
      combined_[k] = weight[k] * sum;
    }
  });
  apply(system.sampling->test, combined_, rhs_);
  add_flux(fluxes_, i, s.rate_now, rhs_);
  if (!first) add_flux(fluxes_before_, i, s.rate_before, rhs_);
}

/// The first two steps have no third derivative to go by. The local error of Euler's method, dt^2 u''/2, is about the
/// square of the relative change dt u'/u of a field that grows or decays.
double Sbdf2::early_error(const System& system, const State& state, const std::vector<Vector>& next) {
  double worst = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const Vector& now = state.now[i];
    const double size = dot(now, now);
    if (size == 0 || system.species[i].algebraic) continue;
    const Vector change = next[i] - now;
    worst = std::max(worst, dot(change, change) / std::max(size, negligible_square(now)));
  }
  return worst;
}

/// The square of what errors of a field are relative to: its size or, where rates know gradients, which a constant does
/// not change, its deviation from the mean, but not less than a hundredth of the size.
double reference_square(const System& system, const Vector& field, double square) {
  if (!system.add_gradients && !system.fluxes) return square;
  const double amount = sum(field), deviation = square - amount * amount / static_cast<double>(field.size());
  return std::max(deviation, 1e-4 * square);
}

/// The local error of backward differences of second order, 2/9 dt^3 u''', and as much again twice for the extrapolated
/// reaction; u''' from the third divided difference. Root mean square, relative to the size of the field or what
/// reference_square() says. Coefficients
/// that a clamp holds or has just let go have no third derivative; of those, only the part by which a step shoots
/// through the clamp counts as error, without which reactions too fast for the step would go unseen.
double Sbdf2::error_estimate(const System& system, const State& state, const std::vector<Vector>& next, double dt) {
  if (state.past.size() < 2) return early_error(system, state, next);
  const double t1 = -dt, t2 = t1 - state.past_steps[0], t3 = t2 - state.past_steps[1];
  // Divided difference [u(0), u(t1), u(t2), u(t3)] as weights of the four states.
  const double c0 = -1 / (t1 * t2 * t3), c1 = 1 / (t1 * (t1 - t2) * (t1 - t3)), c2 = 1 / (t2 * (t2 - t1) * (t2 - t3)),
               c3 = 1 / (t3 * (t3 - t1) * (t3 - t2));
  const double scale = 6 * (2.0 / 3) * dt * dt * dt;
  double worst = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (system.species[i].algebraic) continue;  // no error of its own is carried on
    const Vector &u0 = next[i], &u1 = state.now[i], &u2 = state.past[0][i], &u3 = state.past[1][i];
    const Species& s = system.species[i];
    auto free = [&](double u) { return u > s.lower && u < s.upper; };
    auto partial = [&](std::size_t begin, std::size_t end) {
      Eigen::Array2d sum{0, 0};
      for (auto k = static_cast<Eigen::Index>(begin); k < static_cast<Eigen::Index>(end); ++k) {
        sum[1] += u0[k] * u0[k];
        double error = 0;
        if (free(u0[k]) && free(u1[k]) && free(u2[k]) && free(u3[k]))
          error = scale * (c0 * u0[k] + c1 * u1[k] + c2 * u2[k] + c3 * u3[k]);
        else if (free(u1[k]))
          error = u0[k] - std::clamp(u0[k], s.lower, s.upper);
        sum[0] += error * error;
      }
      return sum;
    };
    const auto sums = ordered_sum(static_cast<std::size_t>(u0.size()), Eigen::Array2d{0, 0}, partial);
    const double reference = std::max(reference_square(system, u0, sums[1]), negligible_square(u0));
    if (sums[1] > 0) worst = std::max(worst, std::sqrt(sums[0] / reference));
  }
  return worst;
}

/// The polynomial through the last states, of degree two at most, continued; held coefficients without rounding.
void Sbdf2::first_guess(const System& system, const State& state, std::size_t i, double dt) {
  Vector& guess = next_[i];
  guess = state.now[i];
  if (!state.past.empty()) extrapolate(state, i, dt, guess);
  if (const Held* held = held_of(system, i))
    for (Eigen::Index k = 0; k < guess.size(); ++k)
      if ((*held)[static_cast<std::size_t>(k)]) guess[k] = state.now[i][k];
  if (system.set_values) system.set_values(i, state.time + dt, guess);
}

void Sbdf2::extrapolate(const State& state, std::size_t i, double dt, Vector& guess) {
  const double t1 = state.past_steps[0];
  if (state.past.size() < 2) {
    axpby(-dt / t1, state.past[0][i], 1 + dt / t1, guess);
  } else {
    const double t2 = t1 + state.past_steps[1];
    axpby(-dt * (dt + t2) / (t1 * (t2 - t1)), state.past[0][i], (dt + t1) * (dt + t2) / (t1 * t2), guess);
    axpby(dt * (dt + t1) / (t2 * (t2 - t1)), state.past[1][i], 1, guess);
  }
}

/// The rows of all coupled species, each divided by what stands before M u_i^(n+1).
void Sbdf2::solve_coupled(const System& system, const State& state, const Scheme& s, const StepRequest& request,
                          StepReport& report) {
  const CoupledSpecies& c = system.coupled;
  Eigen::MatrixXd flux = c.diffusion;
  std::vector<Vector> b, x;
  for (std::size_t k = 0; k < c.index.size(); ++k) {
    const std::size_t i = c.index[k];
    const bool algebraic = system.species[i].algebraic;
    const double dt = request.dt;
    right_hand_side(system, algebraic ? Scheme{1, 0, 0, s.rate_now / dt, s.rate_before / dt} : s, i);
    b.push_back(algebraic ? rhs_ : rhs_ / s.alpha);
    if (!algebraic) flux.row(static_cast<Eigen::Index>(k)) *= dt / s.alpha;
    first_guess(system, state, i, dt);
    x.push_back(std::move(next_[i]));
  }
  coupled_.update(system.mass, c.stiffness, flux);
  solve_noted(coupled_names(system), report,
              [&] { return coupled_.solve(b, x, {.tolerance = request.solver_tolerance}); });
  for (std::size_t k = 0; k < c.index.size(); ++k) next_[c.index[k]] = std::move(x[k]);
}

/// Fields at the samples, now and before; those of the step before are known, unless the surface has moved since.
void Sbdf2::sample(const System& system, const State& state) {
  const bool still = sampled_by_ == system.sampling;
  if (still && sampled_at_ == state.step) return;
  if (still && sampled_at_ + 1 == state.step)
    std::swap(samples_, samples_before_);
  else if (!state.past.empty())
    sample_fields(system, state.past[0], samples_before_);
  sample_fields(system, state.now, samples_);
  sampled_by_ = system.sampling;
  sampled_at_ = state.step;
}

/// Adds a constant such that alpha M x + dt K x = b, summed, holds to rounding: what only flows keeps its amount
/// whatever the tolerance of the solver.
void balance(const SparseMatrix& mass, double alpha, const Vector& b, Vector& x) {
  const Vector weight = mass * Vector::Ones(mass.rows());
  x.array() += (sum(b) / alpha - dot(weight, x)) / sum(weight);
}

StepReport Sbdf2::step(const System& system, State& state, const StepRequest& request) {
  const double dt = request.dt;
  const Scheme s = scheme(state, dt);
  sample(system, state);
  evaluate_rates(system, samples_, state.time, rates_);
  fluxes_ = system.fluxes ? system.fluxes(state.now, state.time) : std::vector<Vector>{};
  if (!state.past.empty()) rates_before_ = state.past_rates;
  if (!state.past.empty() && system.fluxes)
    fluxes_before_.assign(rates_before_.begin() + std::ssize(system.species), rates_before_.end());
  StepReport report;
  matrices_.resize(system.species.size());
  next_.resize(system.species.size());
  for (std::size_t i = 0; i < system.species.size(); ++i) {
    const Species& species = system.species[i];
    if (species.follows) next_[i] = state.now[i];
    if (species.coupled || species.follows) continue;
    matrices_[i].update(mass_of(system, i), s.alpha, species.stiffness, dt * species.diffusion, *request.solver);
    right_hand_side(system, s, i);
    first_guess(system, state, i, dt);
    matrices_[i].solve(rhs_, next_[i], held_of(system, i), species.name, request.solver_tolerance, report);
    if (i < fluxes_.size() && fluxes_[i].size() > 0 && !held_of(system, i))
      balance(*mass_of(system, i), s.alpha, rhs_, next_[i]);
  }
  if (!system.coupled.index.empty()) solve_coupled(system, state, s, request, report);
  if (report.failure.empty()) {
    report.error = error_estimate(system, state, next_, dt);
    if (report.error > request.largest_error) return report;
  }
  advance(system, state, dt, next_, report);
  if (report.accepted) {
    state.past_rates = rates_;
    if (system.fluxes) state.past_rates.insert(state.past_rates.end(), fluxes_.begin(), fluxes_.end());
  }
  return report;
}

/// On the amplitudes of two states.
Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  using Eigen::MatrixXd;
  const Eigen::Index n = l.jacobian.rows();
  const MatrixXd one = MatrixXd::Identity(n, n);
  const Eigen::VectorXd algebraic = Eigen::VectorXd::Ones(n) - l.evolving;
  const MatrixXd evolving = l.evolving.asDiagonal(), scale = (dt * l.evolving + algebraic).asDiagonal();
  // The Jacobian of an algebraic species is that of its formula minus itself, and only the formula is extrapolated.
  const MatrixXd rates = scale * (l.jacobian + MatrixXd(algebraic.asDiagonal()));
  const MatrixXd implicit = 1.5 * evolving + MatrixXd(algebraic.asDiagonal()) + scale * decay;
  MatrixXd g = MatrixXd::Zero(2 * n, 2 * n);
  g.topLeftCorner(n, n) = solved(implicit, 2 * evolving + 2 * rates);
  g.topRightCorner(n, n) = -solved(implicit, 0.5 * evolving + rates);
  g.bottomLeftCorner(n, n) = one;
  return g;
}

}  // namespace

constexpr StepperKind sbdf2 = {.name = "sbdf2",
                               .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<Sbdf2>(); },
                               .adaptive = true,
                               .couples = true,
                               .holds = true,
                               .keeps_rates = true,
                               .amplification = amplification,
                               .tolerance = 1e-2,
                               .jump_tolerance = 1e-2,
                               .dilutes = true,
                               .gives_values = true,
                               .symmetric = true,
                               .solves = true};

}  // namespace pelage
