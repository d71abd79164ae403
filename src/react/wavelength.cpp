#include "react/wavelength.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/number.h"
#include "base/random.h"
#include "react/stability.h"

namespace pelage {

namespace {

/// The model at the values for which its file gives the wavelength.
Model at_reference(const Model& model) {
  ModelSource source = model.source();
  for (ParameterSource& p : source.parameters) p.value = p.reference.value_or(p.value);
  return compile(source);
}

/// "Dg = 0.008, Ds = 0.06": the parameters that are not at their reference.
std::string changes(const Model& model) {
  std::string text;
  for (const ParameterSource& p : model.parameters())
    if (p.reference && *p.reference != p.value)
      text += (text.empty() ? "" : ", ") + p.name + " = " + exact_number(p.value);
  return text;
}

/// What the equations are made of, at many states and times; quantities of the place at their mean as for Stability.
struct EquationValues {
  std::vector<double> rates, diffusions;
  std::vector<double> others;  ///< that have no factor of their own
};

EquationValues values_of(const Model& model) {
  constexpr std::uint64_t states = 256, seed = 1;  // many enough to meet all branches of the formulas; any
  const Equations& equations = model.equations();
  std::vector<NodeId> diffusions = equations.diffusion;
  diffusions.insert(diffusions.end(), equations.prefactor.begin(), equations.prefactor.end());
  EquationValues values{.rates = {}, .diffusions = {}, .others = equations.cross};
  for (const auto* bounds : {&equations.lower, &equations.upper})
    values.others.insert(values.others.end(), bounds->begin(), bounds->end());
  const std::size_t n = model.species_count();
  for (std::uint64_t k = 0; k < states; ++k) {
    // Concentrations and times over two orders of magnitude, every fourth concentration below 0.
    const auto value = [&](std::uint64_t i) { return std::pow(10.0, 2 * uniform(seed, k * (n + 1) + i) - 1); };
    const auto value_of = [&](const Symbol& symbol) {
      if (symbol.kind == Symbol::Kind::time) return value(n);
      if (symbol.kind == Symbol::Kind::uniform) return 0.5;
      if (symbol.kind == Symbol::Kind::gradients) return value(static_cast<std::uint64_t>(symbol.other));
      if (symbol.kind != Symbol::Kind::species) return 0.0;
      const auto i = static_cast<std::uint64_t>(symbol.index);
      return (k + i) % 4 == 3 ? -value(i) : value(i);
    };
    const auto append = [&](std::vector<double>& list, const std::vector<NodeId>& roots) {
      const std::vector<double> more = evaluate(equations.graph, roots, value_of);
      list.insert(list.end(), more.begin(), more.end());
    };
    append(values.rates, equations.rate);
    for (const Flux& flux : equations.fluxes) append(values.others, {flux.coefficient});
    const std::vector<double> d = evaluate(equations.graph, diffusions, value_of);
    for (std::size_t i = 0; i < n; ++i) values.diffusions.push_back(d[i] * d[n + i]);
    for (const auto& tensor : equations.tensor)
      if (tensor) append(values.diffusions, {tensor->begin(), tensor->end()});
    for (const auto& a : equations.anisotropy) {
      if (!a) continue;
      const std::vector<double> t = evaluate(equations.graph, std::vector<NodeId>{a->a1, a->theta}, value_of);
      values.diffusions.push_back(t[0] * t[0]);
      values.others.push_back(t[1]);
    }
  }
  return values;
}

/// f with b = f a, exactly 1 where b = a; nothing where there is none. Values that are no numbers in both do not count.
std::optional<double> common_factor(const std::vector<double>& a, const std::vector<double>& b) {
  double factor = 1, largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::isfinite(a[k]) && std::abs(a[k]) > largest) {
      largest = std::abs(a[k]);
      factor = b[k] / a[k];
    }
  constexpr double rounding = 1e-9;  // of sums in which terms cancel
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!std::isfinite(a[k]) && !std::isfinite(b[k])) continue;
    if (!(std::abs(b[k] - factor * a[k]) <= rounding * std::abs(b[k]))) return std::nullopt;
  }
  return factor > 0 ? std::optional(factor) : std::nullopt;
}

/// By which factor all lengths differ where the equations differ in their units of length and time alone.
std::optional<double> change_of_units(const Model& reference, const Model& model) {
  const EquationValues before = values_of(reference), now = values_of(model);
  if (now.others != before.others) return std::nullopt;
  const auto rate = common_factor(before.rates, now.rates),
             diffusion = common_factor(before.diffusions, now.diffusions);
  if (!rate || !diffusion) return std::nullopt;
  // Formulas of algebraic species and coefficients of lap() and gradients would have to change in their own ways.
  if ((!model.coupled().empty() || model.has_gradients()) && (*rate != 1 || *diffusion != 1)) return std::nullopt;
  return std::sqrt(*diffusion / *rate);
}

/// The fastest wave, if it grows and stands.
std::optional<double> standing_wave(const Model& model) {
  const Stability s = analyse(model);
  return s.band_min && !s.oscillatory ? s.wavelength : std::nullopt;
}

/// Where the finished pattern is that of the fastest wave, its spacing is within this share of it: closer in all
/// shipped models of one pattern. Beyond, the measured number is of another one, of two coupled layers for example.
constexpr double most_deviation = 0.25;

/// By which factor the spacing, measured at the reference, differs from it, without a formula.
double scaling_by_theory(const Model& model, double measured) {
  const Model reference = at_reference(model);
  if (const auto scale = change_of_units(reference, model)) return *scale;
  const auto there = standing_wave(reference), here = standing_wave(model);
  const bool applies = there && std::abs(measured / *there - 1) <= most_deviation;
  if (applies && here) return *here / *there;
  throw Error(Fault::usage,
              "the wavelength of model \"" + model.name() + "\" is measured at the values of its file; with " +
                  changes(model) + " it is unknown, since " +
                  (applies ? "linear theory has no standing wave that grows there"
                           : "linear theory has no wave of that length") +
                  "; choose other values, give --unit instead of --size, or make `wavelength` in a file of your own a "
                  "formula of the parameters",
              model.source().where);
}

/// The formula `wavelength`, if there is one.
std::optional<double> law(const Model& model) {
  const auto node = model.equations().wavelength_law;
  if (!node) return std::nullopt;
  const Location& where = model.source().wavelength_law->where;
  const auto value = model.equations().graph.constant_value(*node);
  if (!value) throw Error(Fault::usage, "a wavelength must be a number or made of parameters", where);
  if (!(*value > 0 && std::isfinite(*value)))
    throw Error(Fault::usage,
                "model \"" + model.name() +
                    "\" has no pattern of a certain wavelength with these parameters (its formula gives " +
                    exact_number(*value) + "); choose others",
                where);
  return value;
}

double theory(const Model& model) {
  if (const auto critical = analyse(model).wavelength) return *critical;
  throw Error(Fault::usage,
              "model \"" + model.name() +
                  "\" has no wavelength of its own with these parameters (no uniform state with a fastest growing "
                  "wave), so that a size says nothing; give the length of its unit instead (--unit, in recipes "
                  "`unit`), or `wavelength` in its file",
              model.source().where);
}

}  // namespace

double model_wavelength(const Model& model) {
  const auto measured = model.source().wavelength;
  const auto here = law(model);
  if (!measured) return here ? *here : theory(model);
  return *measured * (here ? *here / *law(at_reference(model)) : scaling_by_theory(model, *measured));
}

std::optional<double> known_wavelength(const Model& model) {
  try {
    return model_wavelength(model);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<double> diffusion_length(const Model& model) {
  const Stability s = analyse(model);
  if (s.steady_states.empty() || !model.coupled().empty()) return std::nullopt;
  double rate = 0, diffusion = std::numeric_limits<double>::infinity();
  for (const std::complex<double> z : s.eigenvalues) rate = std::max(rate, std::abs(z));
  for (const double d : s.diffusion)
    if (d > 0) diffusion = std::min(diffusion, d);
  const double length = 2 * std::numbers::pi * std::sqrt(diffusion / rate);
  return length > 0 && std::isfinite(length) ? std::optional(length) : std::nullopt;
}

bool states_wavelength(const ModelSource& source) { return source.wavelength || source.wavelength_law; }

}  // namespace pelage
