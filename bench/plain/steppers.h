#pragma once
// Forward Euler, RKC2 and SBDF2 for du/dt = -unit^2 D M^-1 K u + R(u), two species, fused loops. Species that the model
// bounds below are cut off there: in the rates, and after every step.

#include <cmath>
#include <utility>
#include <vector>

#include "linear_elements.h"
#include "models.h"

namespace plain {

template <class R>
using Field = std::vector<Pair<R>>;

template <class Model, class R>
struct Problem {
  using Real = R;
  std::vector<int> begin, column;
  std::vector<R> stiffness;  ///< times the square of the length unit
  std::vector<R> mass, place;
  Pair<R> lower;  ///< bounds of the species
  double radius;  ///< spectral, of M^-1 K

  Problem(const Elements& e, double unit, const std::vector<double>& places, const Pair<double>& bounds)
      : begin(e.begin),
        column(e.column),
        mass(e.mass.begin(), e.mass.end()),
        place(places.begin(), places.end()),
        lower(bounds.cast<R>()),
        radius(unit * unit * spectral_radius(e)) {
    for (const double k : e.stiffness) stiffness.push_back(static_cast<R>(unit * unit * k));
  }

  int size() const { return static_cast<int>(mass.size()); }
  static Pair<R> diffusion() { return {static_cast<R>(Model::diffusion[0]), static_cast<R>(Model::diffusion[1])}; }
  Pair<R> cut(const Pair<R>& u) const { return u.max(lower); }
  Pair<R> rates(const Field<R>& u, int i) const { return Model::rates(cut(u[i]), place[i]); }
  /// Row i of K u.
  Pair<R> row(const Field<R>& u, int i) const {
    Pair<R> sum(0, 0);
    for (int s = begin[i]; s < begin[i + 1]; ++s) sum += stiffness[s] * u[column[s]];
    return sum;
  }
  Pair<R> slope(const Field<R>& u, int i) const { return rates(u, i) - diffusion() / mass[i] * row(u, i); }
  /// Of the largest diffusion and the reaction, with some room.
  double stiffest() const { return 1.02 * radius * std::max(Model::diffusion[0], Model::diffusion[1]) + Model::stiff; }
};

/// What all steppers say: advance() replaces u; before() is what it was; evaluations() counts slopes, or products.
template <class P>
class Euler {
 public:
  using R = typename P::Real;
  explicit Euler(const P& problem) : p_(problem) {}
  static double longest_step(const P& problem) { return 1.8 / problem.stiffest(); }

  void advance(Field<R>& u, double dt) {
    next_.resize(u.size());
    const R step = static_cast<R>(dt);
#pragma omp parallel for
    for (int i = 0; i < p_.size(); ++i) next_[i] = p_.cut(u[i] + step * p_.slope(u, i));
    std::swap(u, next_);
    ++evaluations_;
  }
  const Field<R>& before() const { return next_; }
  long evaluations() const { return evaluations_; }
  /// Numbers per vertex that a slope moves beside its row of the matrix.
  static constexpr int traffic = 6;

 private:
  const P& p_;
  Field<R> next_;
  long evaluations_ = 0;
};

/// Coefficients of Sommeijer, Shampine, Verwer, "RKC: an explicit solver for parabolic PDEs" (1997), section 2, for a
/// step of 1. Entry j is that of stage j.
struct RkcCoefficients {
  std::vector<double> mu, nu, mu_tilde, gamma_tilde;
  explicit RkcCoefficients(int stages);
  /// So many that dt times the spectral radius is inside of the stable interval.
  static int stages(double dt, double radius) {
    return std::max(2, 1 + static_cast<int>(std::sqrt(1 + 1.54 * dt * radius)));
  }
};

template <class P>
class Rkc2 {
 public:
  using R = typename P::Real;
  explicit Rkc2(const P& problem) : p_(problem) {}

  void advance(Field<R>& u, double dt) {
    const int stages = RkcCoefficients::stages(dt, p_.stiffest());
    const RkcCoefficients c(stages);
    for (Field<R>* f : {&slope_, &last_, &next_}) f->resize(u.size());
    const R first = static_cast<R>(dt * c.mu_tilde[1]);
#pragma omp parallel for
    for (int i = 0; i < p_.size(); ++i) {
      slope_[i] = p_.slope(u, i);
      next_[i] = u[i];
      last_[i] = u[i] + first * slope_[i];
    }
    for (int j = 2; j <= stages; ++j) stage(u, c, j, dt, j == stages);
    std::swap(u, last_);
    evaluations_ += stages;
  }
  const Field<R>& before() const { return last_; }
  long evaluations() const { return evaluations_; }
  static constexpr int traffic = 12;

 private:
  /// Y_j from Y_(j-1) in last_ and Y_(j-2) in next_; then it is last_.
  void stage(const Field<R>& u, const RkcCoefficients& c, int j, double dt, bool is_final) {
    const R mu = static_cast<R>(c.mu[j]), nu = static_cast<R>(c.nu[j]), rest = 1 - mu - nu,
            mu_tilde = static_cast<R>(dt * c.mu_tilde[j]), gamma_tilde = static_cast<R>(dt * c.gamma_tilde[j]);
#pragma omp parallel for
    for (int i = 0; i < p_.size(); ++i) {
      const Pair<R> y =
          rest * u[i] + mu * last_[i] + nu * next_[i] + mu_tilde * p_.slope(last_, i) + gamma_tilde * slope_[i];
      next_[i] = is_final ? p_.cut(y) : y;
    }
    std::swap(last_, next_);
  }

  const P& p_;
  Field<R> slope_, last_, next_;
  long evaluations_ = 0;
};

/// Semi-implicit differences of second order: (3 u+ - 4 u + u-) / 2 dt = 2 R(u) - R(u-) - D M^-1 K u+, after a first
/// step of first order. Both species are solved for at once by conjugate gradients with the diagonal as preconditioner.
template <class P>
class Sbdf2 {
 public:
  using R = typename P::Real;
  explicit Sbdf2(const P& problem) : p_(problem) {}

  void advance(Field<R>& u, double dt) {
    for (Field<R>* f : {&rates_, &residual_, &direction_, &product_}) f->resize(u.size());
    if (steps_ == 0) before_ = long_before_ = u;
    if (steps_ == 0) past_rates_.assign(u.size(), Pair<R>::Zero());
    second_ = steps_ > 0 ? R(1) : R(0);
    alpha_ = R(1) + second_ / 2;
    scaled_ = static_cast<R>(dt) * P::diffusion();
    start(u, static_cast<R>(dt));
    std::swap(long_before_, before_);
    std::swap(before_, u);
    std::swap(u, guess_);
    std::swap(rates_, past_rates_);
    solve(u);
    ++steps_;
  }
  const Field<R>& before() const { return before_; }
  long evaluations() const { return evaluations_; }
  static constexpr int traffic = 14;

 private:
  static constexpr double tolerance = 1e-6;

  /// The first guess by extrapolation, and the right-hand side in residual_.
  void start(const Field<R>& u, R dt) {
    guess_.resize(u.size());
    const R one = second_, two = steps_ > 1 ? R(1) : R(0);
#pragma omp parallel for
    for (int i = 0; i < p_.size(); ++i) {
      rates_[i] = p_.rates(u, i);
      const Pair<R> past = one * (u[i] - before_[i]);
      guess_[i] = u[i] + past + two * (past - before_[i] + long_before_[i]);
      residual_[i] = p_.mass[i] * (alpha_ * u[i] + past / 2 + dt * (rates_[i] + one * (rates_[i] - past_rates_[i])));
    }
  }

  Pair<R> matrix_row(const Field<R>& x, int i) const { return alpha_ * p_.mass[i] * x[i] + scaled_ * p_.row(x, i); }
  /// The diagonal of the lumped mass and of K; that of K is found in its row.
  Pair<R> preconditioned(const Field<R>& r, int i) const { return r[i] / diagonal_[i]; }

  void set_diagonal() {
    diagonal_.resize(residual_.size());
#pragma omp parallel for
    for (int i = 0; i < p_.size(); ++i)
      for (int s = p_.begin[i]; s < p_.begin[i + 1]; ++s)
        if (p_.column[s] == i) diagonal_[i] = alpha_ * p_.mass[i] + scaled_ * p_.stiffness[s];
  }

  void solve(Field<R>& x) {
    set_diagonal();
    double b0 = 0, b1 = 0, r0 = 0, r1 = 0, z0 = 0, z1 = 0;  // sums of b b, r r and r z of both species
#pragma omp parallel for reduction(+ : b0, b1, r0, r1, z0, z1)
    for (int i = 0; i < p_.size(); ++i) {
      const Pair<R> b = residual_[i], r = b - matrix_row(x, i);
      residual_[i] = r;
      direction_[i] = preconditioned(residual_, i);
      add(b * b, b0, b1);
      add(r * r, r0, r1);
      add(r * direction_[i], z0, z1);
    }
    const double goal0 = tolerance * tolerance * b0, goal1 = tolerance * tolerance * b1;
    for (int k = 0; k < 1000 && (r0 > goal0 || r1 > goal1); ++k) {
      double q0 = 0, q1 = 0, next0 = 0, next1 = 0;
#pragma omp parallel for reduction(+ : q0, q1)
      for (int i = 0; i < p_.size(); ++i) {
        product_[i] = matrix_row(direction_, i);
        add(product_[i] * direction_[i], q0, q1);
      }
      // A species that is there already stays where it is.
      const Pair<R> step(r0 > goal0 ? ratio(z0, q0) : 0, r1 > goal1 ? ratio(z1, q1) : 0);
      r0 = r1 = 0;
#pragma omp parallel for reduction(+ : r0, r1, next0, next1)
      for (int i = 0; i < p_.size(); ++i) {
        x[i] += step * direction_[i];
        residual_[i] -= step * product_[i];
        add(residual_[i] * residual_[i], r0, r1);
        add(residual_[i] * preconditioned(residual_, i), next0, next1);
      }
      const Pair<R> beta(ratio(next0, z0), ratio(next1, z1));
      z0 = next0;
      z1 = next1;
#pragma omp parallel for
      for (int i = 0; i < p_.size(); ++i) direction_[i] = preconditioned(residual_, i) + beta * direction_[i];
      ++evaluations_;
    }
#pragma omp parallel for
    for (int i = 0; i < p_.size(); ++i) x[i] = p_.cut(x[i]);
    ++evaluations_;
  }
  /// 0 for a species whose residual has vanished, as that of a uniform one does.
  static R ratio(double above, double below) { return below > 0 ? static_cast<R>(above / below) : R(0); }
  static void add(const Pair<R>& value, double& first, double& second) {
    first += value[0];
    second += value[1];
  }

  const P& p_;
  R second_ = 0, alpha_ = 1;
  Pair<R> scaled_;
  Field<R> before_, long_before_, rates_, past_rates_, guess_, residual_, direction_, product_, diagonal_;
  long steps_ = 0, evaluations_ = 0;
};

}  // namespace plain
