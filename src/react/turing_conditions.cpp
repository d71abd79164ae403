#include "react/turing_conditions.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"

namespace pelage {

namespace {

/// Four significant digits: enough for a threshold.
std::string text_of(double value) { return number(value, 4); }

double norm(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum);
}

/// Growth rates below this are rounding.
double noise(const Stability& stability) { return 1e-9 * norm(stability.jacobian); }

bool uniform_is_stable(const Stability& s) { return s.eigenvalues.front().real() <= noise(s); }

/// Growth rates over log k, from waves so long that diffusion does nothing to ones that it wipes out.
class Growth {
 public:
  explicit Growth(const Stability& stability) : stability_(stability) {
    double fastest = 0, slowest = 0;
    for (const auto* list : {&stability.diffusion, &stability.cross, &stability.fluxes})
      for (const double signed_value : *list) {
        const double d = std::abs(signed_value);
        fastest = std::max(fastest, d);
        if (d > 0 && (slowest == 0 || d < slowest)) slowest = d;
      }
    if (fastest == 0) return;
    const double scale = norm(stability.jacobian);
    low_ = std::log(1e-2 * std::sqrt(scale / fastest));
    high_ = std::log(1e2 * std::sqrt(scale / slowest));
  }

  double at(double log_k) const { return growth_rate(stability_, std::exp(log_k)).real(); }
  double shortest() const { return at(high_); }

  /// The largest growth of any wave: the best of the samples, and of a golden section around it.
  double largest() const {
    constexpr int intervals = 300;  // a maximum of the dispersion relation is about one unit of log k wide
    const double width = (high_ - low_) / intervals;
    int best = 0;
    double growth = at(low_);
    for (int i = 1; i <= intervals; ++i)
      if (const double g = at(low_ + i * width); g > growth) growth = g, best = i;
    return std::max(growth, refine(low_ + (best - 1) * width, low_ + (best + 1) * width));
  }

 private:
  double refine(double a, double b) const {
    constexpr double ratio = 0.61803398874989484820;
    while (b - a > 1e-7) {
      const double c = b - ratio * (b - a), d = a + ratio * (b - a);
      (at(c) > at(d) ? b : a) = at(c) > at(d) ? d : c;
    }
    return at((a + b) / 2);
  }

  const Stability& stability_;
  double low_ = 0, high_ = 0;
};

bool waves_grow(Stability stability, std::size_t species, double diffusion) {
  stability.diffusion[species] = diffusion;
  return Growth(stability).largest() > noise(stability);
}

/// From `inside` outwards by `factor` until growth changes its sign; then bisection on the logarithm.
std::optional<double> threshold_towards(const Stability& stability, std::size_t species, double factor) {
  constexpr double reach = 1e4;
  const double start = stability.diffusion[species];
  const bool grows = waves_grow(stability, species, start);
  double inside = start, outside = start;
  do {
    inside = outside;
    outside *= factor;
    if (outside > start * reach || outside < start / reach) return std::nullopt;
  } while (waves_grow(stability, species, outside) == grows);
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(inside * outside);
    (waves_grow(stability, species, middle) == grows ? inside : outside) = middle;
  }
  return std::sqrt(inside * outside);
}

std::optional<DiffusionThreshold> nearest_threshold(const Stability& stability, std::size_t species) {
  constexpr double factor = 1.2;
  const auto up = threshold_towards(stability, species, factor);
  const auto down = threshold_towards(stability, species, 1 / factor);
  if (!up && !down) return std::nullopt;
  const double start = stability.diffusion[species];
  const bool upwards = up && (!down || *up / start < start / *down);
  const double value = upwards ? *up : *down;
  return DiffusionThreshold{species, value, waves_grow(stability, species, value * factor)};
}

/// Two evolving species with a diffusion each: what the classical theory is about.
bool classical_pair(const Stability& s) {
  return s.diffusion.size() == 2 && s.cross.empty() && s.fluxes.empty() && s.algebraic.empty();
}

/// "WHAT = 0.3 > NAME = 0.2", or what relation there is; equal up to rounding does not hold.
Condition condition(const std::string& what, double value, bool greater, const std::string& name, double bound) {
  const bool equal = std::abs(value - bound) <= 1e-12 * std::max(std::abs(value), std::abs(bound));
  const bool holds = !equal && (value > bound) == greater;
  const std::string relation = equal ? " = " : value > bound ? " > " : " < ";
  return {what + " = " + text_of(value) + relation + (name.empty() ? "" : name + " = ") + text_of(bound), holds};
}

std::vector<Condition> conditions_of_two(const Stability& s, const std::vector<std::string>& species) {
  const double fu = s.jacobian[0], fv = s.jacobian[1], gu = s.jacobian[2], gv = s.jacobian[3];
  const double du = s.diffusion[0], dv = s.diffusion[1];
  const std::string u = species[0], v = species[1];
  const double trace = fu + gv, determinant = fu * gv - fv * gu;
  return {condition("trace of the Jacobian", trace, false, "", 0),
          condition("determinant of the Jacobian", determinant, true, "", 0),
          condition("product of its diagonal", fu * gv, false, "", 0),
          condition("D_" + v + " J_" + u + u + " + D_" + u + " J_" + v + v, dv * fu + du * gv, true,
                    "2 sqrt(D_" + u + " D_" + v + " det J)", 2 * std::sqrt(std::max(0.0, du * dv * determinant)))};
}

}  // namespace

Regime regime_of(const Stability& s) {
  if (s.steady_states.empty()) return Regime::no_state;
  const bool stable = uniform_is_stable(s);
  if (s.wavelength && s.growth > noise(s)) {
    if (!stable) return Regime::mixed;
    return s.oscillatory ? Regime::waves : Regime::turing;
  }
  if (!stable) return s.eigenvalues.front().imag() != 0 ? Regime::oscillation : Regime::departure;
  if (Growth(s).shortest() > noise(s)) return Regime::ever_shorter;
  return s.wavelength && s.growth > -noise(s) ? Regime::marginal : Regime::quiet;
}

std::string describe(Regime regime) {
  switch (regime) {
    case Regime::no_state:
      return "no uniform steady state was found; linear theory has nothing to say";
    case Regime::quiet:
      return "no pattern by itself: all small deviations decay; a pattern can only start from a large seed";
    case Regime::marginal:
      return "at the threshold: the fastest wave neither grows nor decays; only unevenness forces a pattern";
    case Regime::turing:
      return "a pattern: waves of a finite length grow, though the uniform state by itself is stable (Turing)";
    case Regime::waves:
      return "waves: those of a finite length grow and oscillate, though the uniform state by itself is stable";
    case Regime::oscillation:
      return "no fixed pattern: the uniform state oscillates as a whole (Hopf)";
    case Regime::departure:
      return "the uniform state is unstable as a whole; what follows depends on the other states";
    case Regime::mixed:
      return "mixed: the uniform state is unstable as a whole, and waves of a finite length grow faster still";
    case Regime::ever_shorter:
      return "the shorter the wave, the faster it grows: these equations set no size for a pattern";
  }
  return "";
}

std::vector<Condition> turing_conditions(const Stability& s, const std::vector<std::string>& species) {
  if (s.steady_states.empty()) return {};
  if (classical_pair(s)) return conditions_of_two(s, species);
  return {condition("largest real part at k = 0", s.eigenvalues.front().real(), false, "", 0),
          condition("largest real part over all k > 0", Growth(s).largest(), true, "", 0)};
}

std::vector<DiffusionThreshold> diffusion_thresholds(const Stability& stability) {
  std::vector<DiffusionThreshold> thresholds;
  if (stability.steady_states.empty() || !uniform_is_stable(stability)) return thresholds;
  for (std::size_t i = 0; i < stability.diffusion.size(); ++i) {
    if (!(stability.diffusion[i] > 0) || !std::isfinite(stability.diffusion[i])) continue;
    if (const auto threshold = nearest_threshold(stability, i)) thresholds.push_back(*threshold);
  }
  return thresholds;
}

std::vector<std::string> describe(const std::vector<DiffusionThreshold>& thresholds, const Stability& stability,
                                  const std::vector<std::string>& species) {
  std::vector<std::string> lines;
  const bool pair = classical_pair(stability) && thresholds.size() == 2;
  for (const DiffusionThreshold& t : thresholds) {
    if (pair && !t.grows_above) continue;  // the other one is the same statement upside down
    const double other = pair ? stability.diffusion[1 - t.species] : 1;
    const std::string name = "D_" + species[t.species] + (pair ? " / D_" + species[1 - t.species] : "");
    const double here = stability.diffusion[t.species] / other, bound = t.diffusion / other;
    const bool grow = t.grows_above ? here > bound * (1 + 1e-6) : here < bound * (1 - 1e-6);
    lines.push_back((grow ? "pattern: " : "no pattern: ") + name + (grow ? " is " : " must be ") +
                    (t.grows_above ? "above " : "below ") + text_of(bound) + ", here it is " + text_of(here));
  }
  return lines;
}

}  // namespace pelage
