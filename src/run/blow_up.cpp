#include "run/blow_up.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "shape/vectors.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// Where the samples are the unknowns.
std::optional<Runaway> unfinite_rate(const System& system, const State& state, double time) {
  if (system.sampling->count() != state.now.front().size()) return std::nullopt;
  std::vector<Vector> samples, rates;
  sample_fields(system, state.now, samples);
  evaluate_rates(system, samples, time, rates);
  for (std::size_t i = 0; i < rates.size(); ++i)
    for (Eigen::Index k = 0; k < rates[i].size(); ++k)
      if (!std::isfinite(rates[i][k])) return Runaway{i, static_cast<std::size_t>(k), rates[i][k]};
  return std::nullopt;
}

Runaway largest_value(const std::vector<Vector>& fields, const std::vector<double>& first_magnitude) {
  Runaway largest;
  double most = -1;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double scale = std::max(first_magnitude[i], negligible);
    for (Eigen::Index k = 0; k < fields[i].size(); ++k) {
      const double u = fields[i][k];
      if (!(std::abs(u) / scale > most)) continue;
      most = std::abs(u) / scale;
      largest = {i, static_cast<std::size_t>(k), u};
    }
  }
  return largest;
}

}  // namespace

Culprit find_culprit(const System& system, const State& state, double time, const std::vector<double>& first_magnitude,
                     const std::optional<Runaway>& runaway) {
  const auto name = [&](const Runaway& at) { return system.species[at.species].name; };
  if (runaway) return {*runaway, name(*runaway) + " becomes " + number(runaway->value)};
  if (const auto rate = unfinite_rate(system, state, time))
    return {*rate, "the rate of " + name(*rate) + " is " + number(rate->value)};
  const Runaway largest = largest_value(state.now, first_magnitude);
  return {largest, name(largest) + " is " + number(largest.value)};
}

namespace {

std::size_t nearest_vertex(const std::vector<Point>& points, const Point& place) {
  std::size_t nearest = 0;
  for (std::size_t v = 1; v < points.size(); ++v)
    if (length(difference(points[v], place)) < length(difference(points[nearest], place))) nearest = v;
  return nearest;
}

/// Amounts that a projection or a step leaves below 0 by a little are no sign of trouble.
constexpr double little = 1e-3;

/// How a species came to be below 0 where it is `now`; empty where it may be.
std::string fall(const Species& species, const Vector& initial, double now) {
  const double most = maximum(initial);
  if (species.algebraic || std::isfinite(species.lower) || !(now < 0 && now < -little * most)) return "";
  if (minimum(initial) >= -little * most)
    return species.name + " went negative: give it min = 0 in the model, or check the signs of its rate";
  const auto n = static_cast<double>(initial.size());
  const double mean = sum(initial) / n, deviation = std::sqrt(dot(initial, initial) / n - mean * mean);
  if (!(mean > 0.3 * deviation)) return "";  // one that swings about 0
  return species.name + " began below 0 in places and went negative: give it min = 0 in the model, or less noise " +
         "(noise() has deviation 1)";
}

}  // namespace

std::string place_in_words(const World& world, std::size_t unknown) {
  const Point place = world.space().geometry(SampleRule::vertices, false).position[unknown];
  const std::vector<Point>& points = world.points();
  return "vertex " + std::to_string(points.empty() ? unknown : nearest_vertex(points, place)) + " (" +
         number(place[0]) + ", " + number(place[1]) + ", " + number(place[2]) + ")";
}

std::string remedy_for_negative(const System& system, const std::vector<Vector>& initial,
                                const std::vector<Vector>& fields, const Runaway& at) {
  const bool known = std::isfinite(at.value);
  for (std::size_t k = 0; k < fields.size(); ++k) {  // the one that is meant, then the others in order
    const std::size_t i = (at.species + k) % fields.size();
    const double now = k == 0 && known ? at.value : fields[i][static_cast<Eigen::Index>(at.unknown)];
    if (std::string text = fall(system.species[i], initial[i], now); !text.empty()) return text;
  }
  return "";
}

}  // namespace pelage
