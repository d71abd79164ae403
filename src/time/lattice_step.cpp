#include "time/lattice_step.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace pelage {

namespace {

/// C2 that differ by no more count as one.
constexpr double rounding = 1e-12;

std::optional<double> constant_of(const Vector& field) {
  const double low = minimum(field), high = maximum(field);
  if (!(high - low <= rounding * std::max(std::abs(low), std::abs(high)))) return std::nullopt;
  return field[0];
}

}  // namespace

std::string why_no_waves(const System& system) {
  if (!system.lattice) return "it needs an even grid";
  if (!system.coupled.index.empty()) return "it does not take species that are coupled by Laplacians";
  if (system.held) return "it cannot hold parts of the grid";
  if (system.fluxes) return "it does not take fluxes";
  for (const Species& s : system.species) {
    if (s.follows) continue;
    if (s.algebraic) return "it does not take " + s.name + ", on which others depend at once";
    if (s.mass) return "the diffusion of " + s.name + " varies";
    if (!s.tensor) return "the diffusion of " + s.name + " is not the same everywhere";
    if (tilted_to_a_border(*system.lattice, *s.tensor))
      return "the diffusion of " + s.name + " is oblique to a closed border; make the grid periodic";
  }
  return {};
}

std::vector<std::size_t> evolving_species(const System& system) {
  std::vector<std::size_t> evolving;
  for (std::size_t i = 0; i < system.species.size(); ++i)
    if (!system.species[i].follows) evolving.push_back(i);
  return evolving;
}

/// The fields themselves where they are samples, with products of gradients behind them where rates read such.
const std::vector<Vector>& LinearParts::at_samples(const System& system, const std::vector<Vector>& fields) {
  if (sampling_ != system.sampling) {
    sampling_ = system.sampling;
    nodal_ = !system.mass || unknowns_are_samples(*sampling_);
  }
  if (nodal_ && !system.add_gradients) return fields;
  sample_fields(system, fields, samples_);
  return samples_;
}

void LinearParts::split(const System& system, const std::vector<Vector>& now, double t) {
  c_.assign(now.size(), 0);
  if (!system.reaction.split) return evaluate(system, now, t);
  const std::vector<Vector>& u = at_samples(system, now);
  FieldPointers in;
  MutableFieldPointers c2, c3;
  rest_.resize(now.size());
  c2_.resize(now.size());
  for (const Vector& field : u) in.push_back(field.data());
  for (std::size_t i = 0; i < now.size(); ++i) {
    c2_[i].resize(system.sampling->count());
    rest_[i].resize(system.sampling->count());
    c2.push_back(c2_[i].data());
    c3.push_back(rest_[i].data());
  }
  parallel_for(static_cast<std::size_t>(system.sampling->count()),
               [&](std::size_t begin, std::size_t end) { system.reaction.split(in, t, begin, end, c2, c3); });
  for (const std::size_t i : evolving_species(system)) {
    if (const auto constant = constant_of(c2_[i]))
      c_[i] = *constant;
    else
      rest_[i] += c2_[i].cwiseProduct(u[i]);
  }
}

void LinearParts::evaluate(const System& system, const std::vector<Vector>& stage, double t) {
  const std::vector<Vector>& u = at_samples(system, stage);
  evaluate_rates(system, u, t, rest_);
  for (const std::size_t i : evolving_species(system))
    if (c_[i] != 0) axpby(-c_[i], u[i], 1, rest_[i]);
}

}  // namespace pelage
