#include "linalg/minimal_residual.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pelage {

namespace {

/// 1 / sqrt(|d|), by which rows and columns are scaled; 1 where the diagonal is 0.
Vector scaling(const SparseMatrix& a) {
  Vector s = diagonal(a);
  for (double& d : s) d = d != 0 ? 1 / std::sqrt(std::abs(d)) : 1;
  return s;
}

/// The recurrences for S A S y = S r with S = |D|^-1/2 and x = S y: Lanczos vectors v, the orthogonal factors of their
/// tridiagonal matrix as rotations (cosine, sine), and the directions w along which y moves. Names of the coefficients
/// as in Elman, Silvester, Wathen 2014, algorithm 4.1.
class Recurrences {
 public:
  Recurrences(const SparseMatrix& a, const Held* held)
      : a_(a), held_(held), scale_(scaling(a)), w_(Vector::Zero(a.rows())), w_old_(w_), v_old_(w_) {}

  /// Begins at a residual, of which `v` is the scaled one.
  void begin(const Vector& residual) {
    v_ = residual.cwiseProduct(scale_);
    gamma_ = eta_ = norm(v_);
    for (Vector* u : {&w_, &w_old_, &v_old_}) u->setZero();
    c_ = c_old_ = 1;
    s_ = s_old_ = 0;
  }
  /// Of the scaled system.
  double residual() const { return std::abs(eta_); }

  void step(Vector& x) {
    v_ /= gamma_;
    const Vector along = scale_.cwiseProduct(v_);
    apply(a_, along, next_);
    clear_held(held_, next_);
    next_ = next_.cwiseProduct(scale_);
    const double delta = dot(v_, next_);
    next_ -= delta * v_ + gamma_ * v_old_;
    const double gamma_next = norm(next_);
    const double alpha0 = c_ * delta - c_old_ * s_ * gamma_, alpha1 = std::hypot(alpha0, gamma_next),
                 alpha2 = s_ * delta + c_old_ * c_ * gamma_, alpha3 = s_old_ * gamma_;
    c_old_ = std::exchange(c_, alpha0 / alpha1);
    s_old_ = std::exchange(s_, gamma_next / alpha1);
    w_old_ = (v_ - alpha3 * w_old_ - alpha2 * w_) / alpha1;
    std::swap(w_old_, w_);
    x += c_ * eta_ * scale_.cwiseProduct(w_);
    eta_ *= -s_;
    std::swap(v_old_, v_);
    std::swap(v_, next_);
    gamma_ = gamma_next;
  }

 private:
  const SparseMatrix& a_;
  const Held* held_;
  Vector scale_, w_, w_old_, v_, v_old_, next_;
  double gamma_ = 0, eta_ = 0, c_ = 1, c_old_ = 1, s_ = 0, s_old_ = 0;
};

}  // namespace

SolveReport minimal_residuals(const SparseMatrix& a, const Vector& b, Vector& x, const Held* held,
                              const ConjugateGradientOptions& options) {
  SolveReport report;
  Recurrences recurrences(a, held);
  double scale = norm(b);
  // The recurrences know the residual of the scaled system: where it is small enough, the true one is looked at.
  while (true) {
    Vector r = b - a * x;
    clear_held(held, r);
    const double length = norm(r);
    if (scale == 0) scale = length;
    report.residual = length != 0 ? length / scale : 0;  // not a number where one is in b or x
    report.converged = report.residual <= options.tolerance;
    if (!(report.residual > options.tolerance) || report.iterations >= options.max_iterations) return report;
    recurrences.begin(r);
    const double target = 0.5 * std::min(1.0, options.tolerance / report.residual) * recurrences.residual();
    for (; recurrences.residual() > target && report.iterations < options.max_iterations; ++report.iterations)
      recurrences.step(x);
  }
}

}  // namespace pelage
