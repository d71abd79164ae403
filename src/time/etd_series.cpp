#include "time/etd_series.h"

#include <algorithm>
#include <cmath>

#include "time/exponential.h"

namespace pelage {

namespace {

/// Radii that are raised so often were not too small: the operator is none of a diffusion.
constexpr int most_trials = 8;

/// Series are exact relative to the change of a field in the step, so that a faint pattern on a large mean is followed
/// as well; a change below this share of the field is none.
constexpr double smallest_change = 1e-3;

std::string why_no_series(const System& system) {
  if (!system.coupled.index.empty()) return "it does not take species that are coupled by Laplacians";
  if (system.set_values) return "it cannot give values at borders";
  for (const Species& s : system.species)
    if (s.algebraic && !s.follows) return "it does not take " + s.name + ", on which others depend at once";
  return {};
}

}  // namespace

void EtdBySeries::Functions::update(double step, double linear, double radius) {
  if (dt == step && c == linear && end == radius) return;
  dt = step;
  c = linear;
  end = radius;
  const std::vector<double> points = chebyshev_points(dt * radius);
  std::vector<std::vector<double>> values(5);
  for (const double x : points) {
    const Phi p = phi_functions(dt * c - x);
    values[0].push_back(dt / 2 * p.half_phi1);
    values[1].push_back(dt * p.phi1);
    values[2].push_back(2 * dt * p.phi1);
    values[3].push_back(4 * dt * (p.phi2 - 2 * p.phi3));
    values[4].push_back(dt * (4 * p.phi3 - p.phi2));
  }
  half_phi1 = chebyshev_series(values[0]);
  phi1 = chebyshev_series(values[1]);
  twice_phi1 = chebyshev_series(values[2]);
  second = chebyshev_series(values[3]);
  third = chebyshev_series(values[4]);
}

/// N of all species at a stage, as coefficients.
void EtdBySeries::find_rest(const System& system, const std::vector<Vector>& stage, double t) {
  const std::vector<Vector> fluxes = system.fluxes ? system.fluxes(stage, t) : std::vector<Vector>{};
  rest_.resize(system.species.size());
  for (const std::size_t i : evolving_) {
    const Vector& samples = parts_.rest(i);
    const bool blown_up = !std::isfinite(dot(samples, samples));  // which is for advance() to say
    rest_[i] = blown_up ? samples : coefficients_from_samples(*system.sampling, *system.mass, samples);
    if (i < fluxes.size() && fluxes[i].size() > 0) {
      work_[i].diffusion.over_mass(fluxes[i], slope_);
      rest_[i] += slope_;
    }
    clear_held(held_of(system, i), rest_[i]);
  }
}

/// Adds series of the diffusion of a species. False where its radius was too small; it has been raised then.
bool EtdBySeries::add(SpeciesWork& work, const Vector& v, std::initializer_list<SeriesSum> sums, StepReport& report) {
  const int products = add_series(work.diffusion, v, sums, work.tolerance);
  if (products < 0) work.diffusion.raise_radius();
  report.iterations += std::max(0, products);
  return products >= 0;
}

/// next_ and the error of the report, from N at the beginning; false where a radius had to be raised.
bool EtdBySeries::take_step(const System& system, const State& state, const StepRequest& request, StepReport& report) {
  const double h = request.dt, t = state.time;
  for (const std::size_t i : evolving_) {
    SpeciesWork& w = work_[i];
    const Vector& u = state.now[i];
    w.functions.update(h, parts_.c(i), w.diffusion.radius());
    w.diffusion.apply(u, slope_);
    rate_ = w.rest + parts_.c(i) * u - slope_;
    clear_held(held_of(system, i), rate_);
    w.tolerance =
        request.solver_tolerance * std::max(h * w.diffusion.length(rate_), smallest_change * w.diffusion.length(u));
    next_[i] = w.end = u;
    if (!add(w, rate_, {{&w.functions.half_phi1, &next_[i]}, {&w.functions.phi1, &w.end}}, report)) return false;
  }
  parts_.evaluate(system, next_, t + h / 2);
  find_rest(system, next_, t + h / 2);
  for (const std::size_t i : evolving_) {
    SpeciesWork& w = work_[i];
    rate_ = rest_[i] - w.rest;
    next_[i] = w.end;
    w.error.setZero(rate_.size());
    const Functions& f = w.functions;
    if (!add(w, rate_, {{&f.twice_phi1, &next_[i]}, {&f.second, &w.end}, {&f.third, &w.error}}, report)) return false;
  }
  parts_.evaluate(system, next_, t + h);
  find_rest(system, next_, t + h);
  for (const std::size_t i : evolving_) {
    SpeciesWork& w = work_[i];
    rate_ = rest_[i] - w.rest;
    slope_.setZero(rate_.size());
    if (!add(w, rate_, {{&w.functions.third, &slope_}}, report)) return false;
    next_[i] = w.end + slope_;
    const double error = w.diffusion.length(slope_ - 2 * w.error), size = w.diffusion.length(next_[i]);
    const double least = negligible * w.diffusion.length(Vector::Ones(slope_.size()));
    if (error > 0) report.error = std::max(report.error, error / std::max(size, least));
  }
  return true;
}

StepReport EtdBySeries::step(const System& system, State& state, const StepRequest& request) {
  if (std::string why = why_no_series(system); !why.empty()) return refusal(std::move(why));
  evolving_ = evolving_species(system);
  work_.resize(system.species.size());
  for (const std::size_t i : evolving_) work_[i].diffusion.update(system, i);
  for (int trial = 0; trial < most_trials; ++trial) {
    StepReport report;
    parts_.split(system, state.now, state.time);
    find_rest(system, state.now, state.time);
    for (const std::size_t i : evolving_) work_[i].rest = rest_[i];
    next_ = state.now;
    if (!take_step(system, state, request, report)) continue;
    if (!(report.error > request.largest_error)) advance(system, state, request.dt, next_, report);
    return report;
  }
  return refusal("its diffusion has eigenvalues that are not real");
}

}  // namespace pelage
