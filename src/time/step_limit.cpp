#include "time/step_limit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.h"
#include "react/kinetics.h"
#include "react/place_values.h"

namespace pelage {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// C2 of every species at a uniform state, curvatures and attributes being 0.
VectorXd split_at(const Model& model, const std::vector<double>& state) {
  const std::vector<Point> place = {Point{}};
  Places places;
  places.positions = place;
  places.normals = place;
  const std::vector<double> zero = {0};
  places.k1 = places.k2 = zero;
  for (const Symbol& s : place_symbols(model))
    if (s.kind == Symbol::Kind::attribute) places.attributes[s.name] = zero;
  const Kinetics kinetics(model, places, 0);
  const std::size_t n = state.size();
  std::vector<double> c2(n), c3(n);
  const double level = 0;  // the product of any two gradients
  std::vector<const double*> u;
  std::vector<double*> c2_out, c3_out;
  for (std::size_t i = 0; i < n; ++i) {
    u.push_back(&state[i]);
    c2_out.push_back(&c2[i]);
    c3_out.push_back(&c3[i]);
  }
  u.resize(kinetics.input_count(), &level);
  kinetics.split(u, 0, 0, 1, c2_out, c3_out);
  return Eigen::Map<VectorXd>(c2.data(), static_cast<Eigen::Index>(n));
}

/// `flux`: of explicit fluxes, as Linearisation::diffusion.
bool stable(const Linearisation& l, const MatrixXd& flux, const StepperKind& stepper, double dt, double largest_k2) {
  // The schemes are first-order at least: round-off and the truncation of exp() stay within the allowance.
  const double allowed = std::exp(1.5 * dt * l.growth) * (1 + 1e-6);
  constexpr int waves = 80;
  for (int i = 0; i <= waves; ++i) {
    const double mu = i == 0 ? 0 : largest_k2 * std::pow(1e-6, 1 - static_cast<double>(i) / waves);
    Linearisation wave = l;
    wave.jacobian -= mu * flux;
    const MatrixXd g = stepper.amplification(wave, dt, mu * l.diffusion);
    if (!g.allFinite() || eigenvalues(g).cwiseAbs().maxCoeff() > allowed) return false;
  }
  return true;
}

}  // namespace

double largest_stable_step(const Model& model, const StepperKind& stepper, double largest_k2) {
  return largest_stable_step(model, analyse(model), stepper, largest_k2);
}

double largest_stable_step(const Model& model, const Stability& s, const StepperKind& stepper, double largest_k2) {
  if (stepper.any_step || s.steady_states.empty()) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<Eigen::Index>(model.species_count());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Linearisation l;
  l.jacobian = Eigen::Map<const RowMajor>(s.jacobian.data(), n, n);
  l.diffusion = Eigen::Map<const VectorXd>(s.diffusion.data(), n).asDiagonal();
  if (!s.cross.empty()) l.diffusion += Eigen::Map<const RowMajor>(s.cross.data(), n, n);
  l.evolving = VectorXd::Ones(n);
  for (std::size_t i = 0; i < s.algebraic.size(); ++i)
    if (s.algebraic[i]) l.evolving[static_cast<Eigen::Index>(i)] = 0;
  l.c2 = split_at(model, s.steady_states[s.chosen]);
  l.growth = std::max(0.0, s.growth);
  MatrixXd flux = MatrixXd::Zero(n, n);
  if (!s.fluxes.empty()) flux = Eigen::Map<const RowMajor>(s.fluxes.data(), n, n);
  const double rate = l.jacobian.cwiseAbs().maxCoeff() +
                      largest_k2 * std::max(l.diffusion.cwiseAbs().maxCoeff(), flux.cwiseAbs().maxCoeff());
  if (!(rate > 0)) return std::numeric_limits<double>::infinity();
  constexpr double ratio = 1.1;
  double good = 1e-3 / rate;
  while (stable(l, flux, stepper, good * ratio, largest_k2)) {
    good *= ratio;
    if (good * rate > 1e9) return std::numeric_limits<double>::infinity();
  }
  double bad = good * ratio;
  for (int i = 0; i < 30; ++i) {
    const double middle = (good + bad) / 2;
    (stable(l, flux, stepper, middle, largest_k2) ? good : bad) = middle;
  }
  return good;
}

}  // namespace pelage
