#include "verify/early_growth.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "catalog/bind.h"
#include "catalog/models.h"
#include "react/stability.h"
#include "run/run.h"
#include "shape/generators.h"
#include "time/step_limit.h"
#include "verify/figure.h"
#include "verify/sphere_spectrum.h"

namespace pelage {

namespace {

/// The model on an even substrate, on the unit sphere.
Program program_on_sphere(const std::string& model, int vertices, double waves) {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  for (const ParameterSource& p : load_model(model).parameters)
    if (p.name == "unevenness") recipe.stages[0].parameters.push_back({p.name, 0, {}});
  recipe.stages[0].size = Given<Length>{{2 * std::numbers::pi / waves, Length::Unit::world}, {}};
  recipe.stages[0].interpolate = true;
  return make_program(recipe, builtin_shape("builtin:sphere?n=" + std::to_string(vertices)));
}

/// The lengths of a run whose waves grow at rates around `growth`.
struct Schedule {
  double dt;
  int settling, measured;  ///< steps
};

Schedule schedule(const Model& model, const Stability& stability, double largest_k2) {
  // Where nothing grows (a marginal system), the decay of the uniform deviation sets the pace.
  const double pace = std::max(stability.growth, std::abs(growth_rate(stability, 0).real()));
  const double stable = 0.5 * largest_stable_step(model, sbdf2, largest_k2);
  // The scheme amplifies oscillations of angular frequency w at a rate of about w (w dt)^3.
  const double turn = std::abs(stability.eigenvalues.front().imag());
  const double dt = std::min({0.02 / pace, stable, turn > 0 ? 0.1 / turn : stable});
  // First the faster decaying mode of each wave is to die out. Then the fastest wave grows e^4 times, so that the turns
  // of oscillating waves, which change their power by a factor of some ten, hide nothing.
  return {dt, static_cast<int>(std::ceil(2.5 / (pace * dt))), static_cast<int>(std::ceil(4 / (pace * dt)))};
}

State noisy_steady_state(const System& system, const std::vector<double>& steady_state) {
  constexpr double amplitude = 1e-7;  // quadratic terms stay below a thousandth after growing e^6.5 times
  State state;
  for (std::size_t s = 0; s < steady_state.size(); ++s) {
    state.now.push_back(Vector::Constant(system.mass->rows(), steady_state[s]));
    for (Eigen::Index i = 0; i < state.now[s].size(); ++i)
      state.now[s][i] += amplitude * (uniform(1 + s, static_cast<std::uint64_t>(i)) - 0.5);
  }
  return state;
}

/// Power of each degree in the deviations of all species together: that of a single one passes through 0 where a wave
/// oscillates.
std::vector<double> deviation_power(const Sampling& sampling, const std::vector<Vector>& coefficients,
                                    const std::vector<double>& steady_state, int max_degree) {
  std::vector<double> sum(static_cast<std::size_t>(max_degree) + 1, 0.0);
  for (std::size_t s = 0; s < coefficients.size(); ++s) {
    const Vector deviation = (sampling.values * coefficients[s]).array() - steady_state[s];
    const auto power = power_by_degree(sampling.position, sampling.weight, deviation, max_degree);
    std::ranges::transform(sum, power, sum.begin(), std::plus<>());
  }
  return sum;
}

/// Growth rate of each degree, from the power before and after `measured` steps; minus infinity where too little is
/// left.
std::vector<double> growth_rates(const System& system, const std::vector<double>& steady_state,
                                 const Schedule& schedule, int max_degree) {
  State state = noisy_steady_state(system, steady_state);
  const auto stepper = sbdf2.make();
  auto advance = [&](int steps) {
    for (int k = 0; k < steps; ++k) stepper->step(system, state, {.dt = schedule.dt, .solver_tolerance = 1e-12});
    return deviation_power(*system.sampling, state.now, steady_state, max_degree);
  };
  const std::vector<double> before = advance(schedule.settling), after = advance(schedule.measured);
  // What decays far below the rest is soon a leak from growing degrees: the mesh tells degrees apart to about 1e-5.
  const double least = 1e-6 * *std::ranges::max_element(after);
  std::vector<double> rate(before.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t l = 0; l < rate.size(); ++l)
    if (after[l] > least) rate[l] = std::log(after[l] / before[l]) / (2 * schedule.measured * schedule.dt);
  return rate;
}

double wave_number(double degree) { return std::sqrt(degree * (degree + 1)); }

/// Wave number of the largest growth rate but for the few lowest degrees: the vertex of the parabola through the three
/// highest values.
double fastest_wave_number(const std::vector<double>& rate) {
  const auto peak = std::clamp<std::ptrdiff_t>(std::max_element(rate.begin() + 3, rate.end()) - rate.begin(), 4,
                                               static_cast<std::ptrdiff_t>(rate.size()) - 2);
  const auto l = static_cast<std::size_t>(peak);
  const double below = rate[l - 1], at = rate[l], above = rate[l + 1];
  if (!std::isfinite(below) || !std::isfinite(above)) return wave_number(static_cast<double>(peak));
  return wave_number(static_cast<double>(peak) + (below - above) / (2 * (below - 2 * at + above)));
}

double parameter(const Model& model, const std::string& name) {
  const auto& all = model.parameters();
  return std::find_if(all.begin(), all.end(), [&](const ParameterSource& p) { return p.name == name; })->value;
}

}  // namespace

EarlyGrowth measure_early_growth(const std::string& model, int vertices, double waves) {
  Program program = program_on_sphere(model, vertices, waves);
  StageProgram& stage = program.stages[0];
  const Stability stability = analyse(stage.model);
  if (!stability.wavelength)
    throw Error(Fault::usage, "model \"" + model + "\" has no uniform state with a fastest growing wave");
  stage.length_unit = stage.size / *stability.wavelength;  // the file's own wavelength is that of finished patterns
  const double unit = stage.length_unit;
  const Run run(std::move(program));
  const System& system = run.system();
  const double k2 = largest_k2(*system.mass, *run.space().stiffness());
  const Schedule times = schedule(run.stage_program().model, stability, k2 * unit * unit);
  EarlyGrowth result;
  result.rate = growth_rates(system, stability.steady_states[stability.chosen], times, static_cast<int>(1.6 * waves));
  for (std::size_t l = 0; l < result.rate.size(); ++l)
    result.wave_number.push_back(wave_number(static_cast<double>(l)) * unit);
  result.wavelength = 2 * std::numbers::pi / (fastest_wave_number(result.rate) * unit);
  return result;
}

std::vector<Figure> verify_early_growth() {
  const EarlyGrowth growth = measure_early_growth("turing", 10242, 25);
  const Model model = compile(load_model("turing"), {{"unevenness", 0}});
  const double s = parameter(model, "s");
  const double expected = 2 * std::numbers::pi * std::sqrt(parameter(model, "Db") / s);
  const Stability stability = analyse(model);
  double worst = 0;
  for (std::size_t l = 18; l <= 34; ++l)
    worst = std::max(worst, std::abs(growth.rate[l] - growth_rate(stability, growth.wave_number[l]).real()));
  return {at_most("early growth of the Turing system: fastest wavelength against 2 pi sqrt(Db/s)",
                  std::abs(growth.wavelength / expected - 1), 0.05),
          at_most("growth rates of 18 to 34 waves around the sphere against the dispersion relation, over s", worst / s,
                  0.01)};
}

}  // namespace pelage
