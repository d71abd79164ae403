#include "time/step_support.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/number.h"
#include "base/parallel.h"

namespace pelage {

void sample_fields(const System& system, const std::vector<Vector>& coefficients, std::vector<Vector>& samples) {
  samples.resize(coefficients.size());
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    if (system.mass)
      apply(system.sampling->values, coefficients[i], samples[i]);
    else
      samples[i] = coefficients[i];
  if (system.add_gradients) system.add_gradients(coefficients, samples);
}

void evaluate_rates(const System& system, const std::vector<Vector>& samples, double t, std::vector<Vector>& rates) {
  FieldPointers u;
  MutableFieldPointers out;
  rates.resize(system.species.size());
  for (const Vector& field : samples) u.push_back(field.data());
  for (Vector& rate : rates) {
    rate.resize(system.sampling->count());
    out.push_back(rate.data());
  }
  parallel_for(static_cast<std::size_t>(system.sampling->count()),
               [&](std::size_t begin, std::size_t end) { system.reaction.rates(u, t, begin, end, out); });
}

void add_flux(const std::vector<Vector>& fluxes, std::size_t i, double factor, Vector& rhs) {
  if (i < fluxes.size() && fluxes[i].size() > 0) axpby(factor, fluxes[i], 1, rhs);
}

void follow(const System& system, double t, std::vector<Vector>& coefficients) {
  if (std::ranges::none_of(system.species, &Species::follows)) return;
  std::vector<Vector> samples, rates;
  sample_fields(system, coefficients, samples);
  evaluate_rates(system, samples, t, rates);
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    if (system.species[i].follows)
      coefficients[i] = system.mass ? coefficients_from_samples(*system.sampling, *system.mass, rates[i]) : rates[i];
}

SolveReport solve_algebraic(const System& system, double t, std::vector<Vector>& coefficients, double tolerance) {
  const CoupledSpecies& c = system.coupled;
  std::vector<Eigen::Index> algebraic;
  for (std::size_t k = 0; k < c.index.size(); ++k)
    if (system.species[c.index[k]].algebraic) algebraic.push_back(static_cast<Eigen::Index>(k));
  if (algebraic.empty()) return {.converged = true};
  std::vector<Vector> samples, rates, rhs, values;
  sample_fields(system, coefficients, samples);
  evaluate_rates(system, samples, t, rates);
  for (const Eigen::Index row : algebraic) {
    rhs.push_back(load(*system.sampling, rates[c.index[static_cast<std::size_t>(row)]]));
    values.push_back(coefficients[c.index[static_cast<std::size_t>(row)]]);
    for (std::size_t k = 0; k < c.index.size(); ++k) {
      const double d = c.diffusion(row, static_cast<Eigen::Index>(k));
      if (d != 0 && !system.species[c.index[k]].algebraic) rhs.back() -= d * (*c.stiffness * coefficients[c.index[k]]);
    }
  }
  CoupledSolver solver;
  solver.update(system.mass, c.stiffness, c.diffusion(algebraic, algebraic));
  const SolveReport report = solver.solve(rhs, values, {.tolerance = tolerance});
  for (std::size_t a = 0; a < algebraic.size(); ++a)
    coefficients[c.index[static_cast<std::size_t>(algebraic[a])]] = std::move(values[a]);
  return report;
}

namespace {

/// No concentration gets there but by blowing up, and the 32-bit numbers of the output still hold it.
constexpr double largest_value = 1e30;

/// So far below `negligible` that nobody sees the jump to 0; squares are still numbers of full precision.
constexpr double vanishing = 1e-120;

/// Number of the first coefficient that is too large or not a number, or -1.
Eigen::Index first_blown_up(const Vector& x) {
  if (dot(x, x) <= largest_value * largest_value) return -1;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!(std::abs(x[i]) <= largest_value)) return i;
  return -1;
}

}  // namespace

void advance(const System& system, State& state, double dt, std::vector<Vector>& next, StepReport& report) {
  report.minimum = std::numeric_limits<double>::infinity();
  report.maximum = -report.minimum;
  report.change = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const Species& species = system.species[i];
    if (species.follows) continue;
    const Eigen::Index bad = first_blown_up(next[i]);
    if (bad >= 0 && report.failure.empty()) note_runaway({i, static_cast<std::size_t>(bad), next[i][bad]}, report);
    if (!report.failure.empty()) return;
    next[i] = next[i].cwiseMax(species.lower).cwiseMin(species.upper);
    const double low = minimum(next[i]), high = maximum(next[i]), largest = std::max(-low, high);
    if (largest > 0 && largest < vanishing) next[i].setZero();
    report.minimum = std::min(report.minimum, low);
    report.maximum = std::max(report.maximum, high);
    if (species.algebraic) continue;  // follows the others, and may come to rest at a constant
    const double moved = norm(Vector(next[i] - state.now[i]));
    const Vector deviation = next[i].array() - sum(next[i]) / static_cast<double>(next[i].size());
    const double least = negligible * std::sqrt(static_cast<double>(deviation.size()));
    const double amplitude = std::max(norm(deviation), least);
    if (moved > 0) report.change = std::max(report.change, moved / (amplitude * dt));
  }
  std::swap(state.now, next);
  state.past.insert(state.past.begin(), std::move(next));
  state.past_steps.insert(state.past_steps.begin(), dt);
  if (state.past.size() > 2) {
    next = std::move(state.past.back());  // its memory serves the next step
    state.past.pop_back();
    state.past_steps.pop_back();
  }
  state.time += dt;
  ++state.step;
  report.accepted = true;
}

void note_runaway(const Runaway& runaway, StepReport& report) {
  report.runaway = runaway;
  report.failure =
      std::isnan(runaway.value) ? "the step leads to what is not a number" : "the step leads beyond all bounds";
}

void StepMatrix::update(const SharedMatrix& mass, double alpha, const SharedMatrix& stiffness, double beta,
                        const SolverKind& solver) {
  const bool same_solver = kind_ == &solver;
  if (same_solver && alpha == alpha_ && beta == beta_ && mass == mass_ && stiffness == stiffness_) return;
  if (!same_solver) solver_ = solver.make();
  if (!matrix_) matrix_ = std::make_unique<SparseMatrix>();
  combine(alpha, *mass, beta, *stiffness, *matrix_);
  solver_->update(*matrix_);
  kind_ = &solver;
  mass_ = mass;
  stiffness_ = stiffness;
  alpha_ = alpha;
  beta_ = beta;
}

void StepMatrix::solve(const Vector& b, Vector& x, const Held* held, const std::string& species, double tolerance,
                       StepReport& report) {
  solve_noted(species, report, [&] { return solver_->solve(b, x, held, tolerance); });
}

namespace {

void note_solve(const SolveReport& solve, const std::string& names, StepReport& report) {
  report.iterations += solve.iterations;
  report.residual = std::max(report.residual, solve.residual);
  if (!solve.positive_definite) ++report.indefinite;
  if (!report.failure.empty() || solve.converged) return;
  if (!solve.positive_definite)
    report.failure = "the matrix of " + names + " is not positive definite: the step is too large";
  else if (std::isnan(solve.residual))
    report.failure = "the solve for " + names + " meets what is not a number";
  else
    report.failure = "the solve for " + names + " did not converge (residual " + number(solve.residual) + ")";
}

}  // namespace

void solve_noted(const std::string& names, StepReport& report, const std::function<SolveReport()>& solve) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  note_solve(solve(), names, report);
  report.solve_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
  ++report.solves;
}

StepReport refusal(std::string why) {
  StepReport report;
  report.failure = std::move(why);
  report.refused = true;
  return report;
}

std::string coupled_names(const System& system) {
  std::string names;
  for (const std::size_t i : system.coupled.index) names += (names.empty() ? "" : " and ") + system.species[i].name;
  return names;
}

}  // namespace pelage
