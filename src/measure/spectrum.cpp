#include "measure/spectrum.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/dense.h"
#include "linalg/spd_factors.h"

namespace pelage {

namespace {

/// Enough for the widths of the lines of real patterns.
constexpr int most_nodes = 30;
/// Of the Gaussians of ln k: nodes lie about so close where patterns are.
constexpr double smoothing = 0.1;

/// Without its mean, in the inner product of the mass.
Vector centred(const SparseMatrix& mass, const std::vector<double>& values) {
  Vector u = Vector::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  const Vector ones = Vector::Ones(u.size()), weights = mass * ones;
  u.array() -= dot(weights, u) / sum(weights);
  return u;
}

/// The tridiagonal matrix of Lanczos's iteration with (M + s^2 K)^-1 M from u, in the inner product of M. All vectors
/// are kept orthogonal to each other.
Eigen::MatrixXd lanczos(const SparseMatrix& mass, const SharedMatrix& step, const Vector& u) {
  constexpr double exhausted = 1e-8;
  const auto solve = spd_inverse(step);  // far nearer than nodes lie to each other
  std::vector<Vector> basis, images;     // q and M q
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(most_nodes, most_nodes);
  Vector q = u;
  int n = 0;
  for (; n < most_nodes; ++n) {
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i < basis.size(); ++i) axpby(-dot(images[i], q), basis[i], 1, q);
    Vector image = mass * q;
    const double length = std::sqrt(std::max(0.0, dot(q, image)));
    if (n > 0) {
      if (length < exhausted) break;
      t(n, n - 1) = t(n - 1, n) = length;
    }
    basis.push_back(q / length);
    images.push_back(image / length);
    q = solve(images.back());
    t(n, n) = dot(images.back(), q);
  }
  return t.topLeftCorner(n, n);
}

}  // namespace

double Spectrum::quantile(double wanted) const {
  double below = 0;
  for (std::size_t i = 0; i < share.size(); ++i) {
    const double middle = below + share[i] / 2;
    if (middle >= wanted) {
      if (i == 0) return wave_number[0];
      const double before = below - share[i - 1] / 2, t = (wanted - before) / (middle - before);
      return wave_number[i - 1] + t * (wave_number[i] - wave_number[i - 1]);
    }
    below += share[i];
  }
  return wave_number.back();
}

std::vector<double> Spectrum::density(const std::vector<double>& at) const {
  std::vector<double> result(at.size(), 0);
  for (std::size_t j = 0; j < at.size(); ++j)
    for (std::size_t i = 0; i < share.size(); ++i) {
      if (!(wave_number[i] > 0)) continue;
      const double x = std::log(at[j] / wave_number[i]) / smoothing;
      result[j] += share[i] * std::exp(-x * x / 2) / (smoothing * std::sqrt(2 * std::numbers::pi));
    }
  return result;
}

double Spectrum::peak() const {
  constexpr double range = 8, step = 1.005;
  const double middle = quantile(0.5);
  std::vector<double> at;
  for (double k = middle / range; k < middle * range; k *= step) at.push_back(k);
  const std::vector<double> d = density(at);
  return at[static_cast<std::size_t>(std::ranges::max_element(d) - d.begin())];
}

Spectrum spectrum(const Space& space, const std::vector<double>& values, double near) {
  const SparseMatrix mass = *space.sampled(SampleRule::quadrature).mass;
  const Vector u = centred(mass, values);
  constexpr double rounding = 1e-12;
  const Vector given = Vector::Map(values.data(), u.size());
  if (!(near > 0) || !(norm(u) > rounding * norm(given))) return {};
  const auto step = std::make_shared<SparseMatrix>(mass);
  combine(1, mass, 1 / (near * near), *space.stiffness(), *step);
  const Modes modes = symmetric_modes(lanczos(mass, step, u));
  Spectrum s;
  for (Eigen::Index i = modes.values.size(); i-- > 0;) {  // the operator falls with k
    const double theta = std::clamp(modes.values[i], 1e-12, 1.0), first = modes.vectors(0, i);
    s.wave_number.push_back(near * std::sqrt(1 / theta - 1));
    s.share.push_back(first * first);
  }
  return s;
}

}  // namespace pelage
