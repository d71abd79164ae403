#include "discretise/lattice_stencil.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage {

namespace {

using Taps = std::array<double, 3>;  // at steps -1, 0, 1

/// Along one axis: mass and stiffness of linear elements under the quadrature xi^2 = 2/3, and the central difference.
struct Axis {
  Taps mass{0, 1, 0}, second{}, first{};
};

Axis axis_of(const Lattice& lattice, std::size_t a) {
  if (lattice.count[a] < 2) return {};
  const double h = lattice.spacing[a];
  return {{1.0 / 12, 10.0 / 12, 1.0 / 12}, {1 / (h * h), -2 / (h * h), 1 / (h * h)}, {-1 / (2 * h), 0, 1 / (2 * h)}};
}

constexpr std::size_t middle = 13;

template <class Weight>
std::array<double, 27> weights(Weight&& weight) {
  std::array<double, 27> result{};
  for (std::size_t n = 0; n < result.size(); ++n)
    if (n != middle) result[n] = weight(std::array{n % 3, n / 3 % 3, n / 9});
  return result;
}

}  // namespace

LatticeStencil lattice_stencil(const Lattice& lattice, const Eigen::Matrix3d& tensor) {
  const std::array axes = {axis_of(lattice, 0), axis_of(lattice, 1), axis_of(lattice, 2)};
  LatticeStencil stencil;
  stencil.correction =
      weights([&](const auto& at) { return -axes[0].mass[at[0]] * axes[1].mass[at[1]] * axes[2].mass[at[2]]; });
  stencil.diffusion = weights([&](const auto& at) {
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        double product = tensor(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        for (std::size_t c = 0; c < 3; ++c)
          product *= a == b && c == a               ? axes[c].second[at[c]]
                     : a != b && (c == a || c == b) ? axes[c].first[at[c]]
                                                    : axes[c].mass[at[c]];
        sum += product;
      }
    return sum;
  });
  return stencil;
}

double largest_rate(const LatticeStencil& stencil, int sweeps) {
  constexpr int waves = 16;  // along an axis; the largest rates are those of the shortest waves, or near them
  const auto symbol = [&](const std::array<double, 27>& weight, double x, double y, double z) {
    double sum = 0;
    for (std::size_t n = 0; n < weight.size(); ++n)
      sum += weight[n] * (std::cos(x * (static_cast<double>(n % 3) - 1) + y * (static_cast<double>(n / 3 % 3) - 1) +
                                   z * (static_cast<double>(n / 9) - 1)) -
                          1);
    return sum;
  };
  double largest = 0;
  // Waves and their opposites are one.
  for (int i = 0; i <= waves; ++i)
    for (int j = -waves; j <= waves; ++j)
      for (int k = -waves; k <= waves; ++k) {
        constexpr double step = std::numbers::pi / waves;
        const double diffusion = symbol(stencil.diffusion, i * step, j * step, k * step),
                     e = symbol(stencil.correction, i * step, j * step, k * step);
        double series = 1;
        for (int s = 0; s < sweeps; ++s) series = 1 + e * series;
        largest = std::max(largest, std::abs(series * diffusion));
      }
  return largest;
}

bool tilted_to_a_border(const Lattice& lattice, const Eigen::Matrix3d& tensor) {
  constexpr double rounding = 1e-12;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (a != b && lattice.count[static_cast<std::size_t>(a)] > 1 && !lattice.periodic[static_cast<std::size_t>(a)] &&
          std::abs(tensor(a, b)) > rounding * tensor.trace())
        return true;
  return false;
}

}  // namespace pelage
