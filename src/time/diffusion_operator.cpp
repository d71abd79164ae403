#include "time/diffusion_operator.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace pelage {

namespace {

/// Far below what a step may be wrong by, and what polynomials of high degree make of it.
constexpr double mass_tolerance = 1e-13;

}  // namespace

void DiffusionOperator::update(const System& system, std::size_t species) {
  const Species& s = system.species[species];
  diffusion_ = s.diffusion;
  const std::shared_ptr<const Held>& held = s.held ? s.held : system.held;
  const SharedMatrix& mass = mass_of(system, species);
  if (mass_ == mass && stiffness_ == s.stiffness && held_ == held && sampling_ == system.sampling) return;
  mass_ = mass;
  stiffness_ = s.stiffness;
  held_ = held;
  sampling_ = system.sampling;
  nodal_ = unknowns_are_samples(*sampling_);
  sums_ = *mass_ * Vector(Vector::Ones(mass_->columns()));
  diagonal_ = sums_ == diagonal(*mass_);
  inverse_sums_ = sums_.unaryExpr([](double l) { return l > 0 ? 1 / l : 0; });
  radius_of_one_ = largest_eigenvalue();
}

void DiffusionOperator::over_mass(const Vector& load, Vector& y) const {
  if (!nodal_) {
    y.setZero(load.size());
    ConjugateGradientWork<Vector> work;
    conjugate_gradient(*mass_, Jacobi(diagonal(*mass_)), load, y, held_.get(), {.tolerance = mass_tolerance}, work);
    return;
  }
  y = inverse_sums_.cwiseProduct(load);
  clear_held(held_.get(), y);
  if (diagonal_) return;
  pelage::apply(*mass_, y, product_);
  y = 2 * y - inverse_sums_.cwiseProduct(product_);
  clear_held(held_.get(), y);
}

void DiffusionOperator::apply(const Vector& x, Vector& y) const {
  pelage::apply(*stiffness_, x, load_);
  over_mass(load_, y);
  y *= diffusion_;
}

double DiffusionOperator::length(const Vector& x) const {
  return std::sqrt(ordered_sum(static_cast<std::size_t>(x.size()), 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t k = begin; k < end; ++k) sum += std::abs(sums_.data()[k]) * x.data()[k] * x.data()[k];
    return sum;
  }));
}

/// By power iteration, of D = 1. Short edges and corners of few triangles have the largest eigenvalues: the start is
/// large where the matrix is, with signs at random.
double DiffusionOperator::largest_eigenvalue() const {
  constexpr int iterations = 60;
  constexpr double enough = 2e-3, margin = 1.05;
  Vector x = diagonal(*stiffness_).cwiseProduct(inverse_sums_.cwiseAbs()), y;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (hash(1, static_cast<std::uint64_t>(i)) % 2) x[i] = -x[i];
  clear_held(held_.get(), x);
  double largest = 0;
  for (int k = 0; k < iterations; ++k) {
    const double before = norm(x);
    if (!(before > 0)) break;
    pelage::apply(*stiffness_, x, load_);
    over_mass(load_, y);
    const double next = norm(y) / before;
    const bool done = k > 8 && next < largest * (1 + enough);
    largest = std::max(largest, next);
    if (done) break;
    x = y / norm(y);
  }
  return margin * largest;
}

}  // namespace pelage
