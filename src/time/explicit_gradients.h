#pragma once
// What a system's gradients add to the rates at the nodes, for steppers whose unknowns are the values there and which
// compute in single precision.

#include <memory>
#include <vector>

#include "time/system.h"

namespace pelage {

class ExplicitGradients {
 public:
  /// `sweeps`: how often the inverse of L^-1 M is improved, see Rkc2.
  explicit ExplicitGradients(int sweeps) : sweeps_(sweeps) {}

  /// Nothing.
  void clear();
  /// Products and fluxes of these fields; those of species that follow may be empty.
  void evaluate(const System& system, std::vector<Vector> fields, double t);

  std::size_t products() const { return products_.size(); }
  const float* product(std::size_t k) const { return products_[k].data(); }
  /// (I + E + ...) L^-1 times the load of the species' flux; null where it has none.
  const float* flux(std::size_t species) const;

  /// By how much the rate of i changes with u_j through gradients at the fields of the last evaluation, at most, on
  /// waves as short as the mesh has them, at [i * species + j] [1/time]. Empty where there are no gradients.
  std::vector<double> jacobian(const System& system, double t) const;

 private:
  std::vector<Vector> flux_rates(const System& system, const std::vector<Vector>& fields, double t) const;
  std::vector<Vector> rates(const System& system, const std::vector<Vector>& fields, double t) const;

  int sweeps_;
  std::vector<Vector> fields_;
  std::vector<std::vector<float>> products_, fluxes_;
};

}  // namespace pelage
