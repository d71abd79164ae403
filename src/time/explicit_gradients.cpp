#include "time/explicit_gradients.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "time/step_support.h"

namespace pelage {

namespace {

std::vector<std::vector<float>> in_single(const std::vector<Vector>& fields, std::size_t first) {
  std::vector<std::vector<float>> single;
  for (std::size_t i = first; i < fields.size(); ++i) single.emplace_back(fields[i].begin(), fields[i].end());
  return single;
}

/// A field that changes its sign from node to node, at random.
Vector shortest_waves(Eigen::Index nodes) {
  Vector z(nodes);
  for (Eigen::Index k = 0; k < nodes; ++k) z[k] = hash(2, static_cast<std::uint64_t>(k)) % 2 ? 1 : -1;
  return z;
}

/// Of the largest value: small beside the field, and large beside its rounding.
constexpr double relative_change = 1e-6;

}  // namespace

void ExplicitGradients::clear() {
  fields_.clear();
  products_.clear();
  fluxes_.clear();
}

void ExplicitGradients::evaluate(const System& system, std::vector<Vector> fields, double t) {
  fields_ = std::move(fields);
  std::vector<Vector> products;
  if (system.add_gradients) system.add_gradients(fields_, products);
  products_ = in_single(products, 0);
  fluxes_ = in_single(flux_rates(system, fields_, t), 0);
}

const float* ExplicitGradients::flux(std::size_t i) const {
  return i < fluxes_.size() && !fluxes_[i].empty() ? fluxes_[i].data() : nullptr;
}

std::vector<Vector> ExplicitGradients::flux_rates(const System& system, const std::vector<Vector>& fields,
                                                  double t) const {
  if (!system.fluxes) return {};
  std::vector<Vector> loads = system.fluxes(fields, t);
  Vector product;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (loads[i].size() == 0) continue;
    const SparseMatrix& mass = *mass_of(system, i);
    const Vector lumped = mass * Vector::Ones(mass.rows());
    const Vector rate = loads[i].cwiseQuotient(lumped);
    loads[i] = rate;
    for (int sweep = 0; sweep < sweeps_; ++sweep) {
      apply(mass, loads[i], product);
      loads[i] += rate - product.cwiseQuotient(lumped);
    }
  }
  return loads;
}

/// With the gradients of `fields`, and with the values of the last evaluation.
std::vector<Vector> ExplicitGradients::rates(const System& system, const std::vector<Vector>& fields, double t) const {
  std::vector<Vector> samples = fields_, rates;
  for (Vector& field : samples)
    if (field.size() == 0) field = Vector::Zero(system.sampling->count());  // no rate reads it
  if (system.add_gradients) system.add_gradients(fields, samples);
  evaluate_rates(system, samples, t, rates);
  const std::vector<Vector> fluxes = flux_rates(system, fields, t);
  for (std::size_t i = 0; i < rates.size(); ++i) add_flux(fluxes, i, 1, rates[i]);
  return rates;
}

std::vector<double> ExplicitGradients::jacobian(const System& system, double t) const {
  if (!system.add_gradients && !system.fluxes) return {};
  const std::size_t n = system.species.size();
  const std::vector<Vector> before = rates(system, fields_, t);
  std::vector<double> largest(n * n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    if (fields_[j].size() == 0) continue;
    const double size = fields_[j].cwiseAbs().maxCoeff(), change = relative_change * (size > 0 ? size : 1);
    std::vector<Vector> fields = fields_;
    fields[j] += change * shortest_waves(fields[j].size());
    const std::vector<Vector> after = rates(system, fields, t);
    for (std::size_t i = 0; i < n; ++i)
      if (!system.species[i].follows) largest[i * n + j] = (after[i] - before[i]).cwiseAbs().maxCoeff() / change;
  }
  return largest;
}

}  // namespace pelage
