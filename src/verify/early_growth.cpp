#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "catalog/resolve.h"
#include "react/stability.h"
#include "run/run.h"
#include "shape/generators.h"
#include "verify/figure.h"
#include "verify/sphere_spectrum.h"

namespace pelage {

namespace {

constexpr int max_degree = 40;  // of the spectrum; the fastest waves go about 25 times around the sphere

/// The Turing system as shipped, on an even substrate, on the unit sphere.
Program turing_on_sphere() {
  Recipe recipe;
  recipe.stage.model.value = "turing";
  recipe.stage.parameters = {{"unevenness", 0, {}}};
  recipe.stage.size = Given<Length>{{0.25, false}, {}};
  recipe.stage.interpolate = true;
  return resolve(recipe, builtin_shape("builtin:sphere?n=10242"));
}

/// Growth rate [1/model time] of each degree of spherical harmonics. On a sphere the degrees do not mix while the
/// deviation from the uniform state is small, so that the power of each one in noise gives its rate without any
/// statistics.
std::vector<double> growth_rates(const Operators& operators, double dt) {
  constexpr double amplitude = 1e-6;  // so that quadratic terms are of relative size 1e-6
  constexpr int settling = 40,
                measured = 60;  // steps; in the first 6 / s the faster decaying mode of each wave dies out
  const System& system = operators.system();
  State state;
  state.now = operators.initial();
  const double uniform_state = state.now[0].mean();
  for (Eigen::Index i = 0; i < state.now[0].size(); ++i)
    state.now[0][i] += amplitude * (uniform(1, static_cast<std::uint64_t>(i)) - 0.5);
  const auto stepper = make_stepper("sbdf2");
  auto advance = [&](int steps) {
    for (int k = 0; k < steps; ++k) stepper->step(system, state, {.dt = dt, .solver_tolerance = 1e-13});
    const Vector deviation = (system.sampling->values * state.now[0]).array() - uniform_state;
    return power_by_degree(system.sampling->position, system.sampling->weight, deviation, max_degree);
  };
  const std::vector<double> before = advance(settling), after = advance(measured);
  std::vector<double> rate(before.size());
  for (std::size_t l = 0; l < rate.size(); ++l) rate[l] = std::log(after[l] / before[l]) / (2 * measured * dt);
  return rate;
}

double wave_number(double degree) { return std::sqrt(degree * (degree + 1)); }

/// Wave number of the largest growth rate: the vertex of the parabola through the three highest values.
double fastest_wave_number(const std::vector<double>& rate) {
  const auto peak = std::clamp<std::ptrdiff_t>(std::max_element(rate.begin() + 10, rate.end()) - rate.begin(), 11,
                                               static_cast<std::ptrdiff_t>(rate.size()) - 2);
  const auto l = static_cast<std::size_t>(peak);
  const double below = rate[l - 1], at = rate[l], above = rate[l + 1];
  return wave_number(static_cast<double>(peak) + (below - above) / (2 * (below - 2 * at + above)));
}

double parameter(const Model& model, const std::string& name) {
  const auto& all = model.parameters();
  return std::find_if(all.begin(), all.end(), [&](const ParameterSource& p) { return p.name == name; })->value;
}

}  // namespace

std::vector<Figure> verify_early_growth() {
  const Program program = turing_on_sphere();
  const Operators operators(program, {});
  const std::vector<double> rate = growth_rates(operators, program.suggested_step);
  const double s = parameter(program.model, "s");
  const double expected = 2 * std::numbers::pi * std::sqrt(parameter(program.model, "Db") / s) * program.length_unit;
  const double measured = 2 * std::numbers::pi / fastest_wave_number(rate);
  const Stability stability = analyse(program.model);
  double worst = 0;
  for (std::size_t l = 18; l <= 34; ++l) {
    const double k = wave_number(static_cast<double>(l)) * program.length_unit;
    worst = std::max(worst, std::abs(rate[l] - growth_rate(stability, k).real()));
  }
  return {at_most("early growth of the Turing system: fastest wavelength against 2 pi sqrt(Db/s)",
                  std::abs(measured / expected - 1), 0.05),
          at_most("growth rates of 18 to 34 waves around the sphere against the dispersion relation, over s", worst / s,
                  0.01)};
}

}  // namespace pelage
