#include "discretise/lattice_stencil.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage {

namespace {

/// Of u'' h^2 = sum of weight (u(x + step h) + u(x - step h) - 2 u(x)), at one step and at two.
constexpr std::array<double, 2> second_difference = {4.0 / 3, -1.0 / 12};

void add_line(const std::array<int, 3>& direction, double factor, LatticeStencil& stencil) {
  for (int steps = 1; steps <= 2; ++steps)
    stencil.neighbours.push_back({{steps * direction[0], steps * direction[1], steps * direction[2]},
                                  factor * second_difference[static_cast<std::size_t>(steps - 1)]});
}

}  // namespace

LatticeStencil lattice_stencil(const Lattice& lattice, const Eigen::Matrix3d& tensor) {
  LatticeStencil stencil;
  for (std::size_t a = 0; a < 3; ++a) {
    if (lattice.count[a] < 2) continue;
    const auto entry = [&](std::size_t b) {
      return tensor(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) /
             (lattice.spacing[a] * lattice.spacing[b]);
    };
    std::array<int, 3> along{};
    along[a] = 1;
    add_line(along, entry(a), stencil);
    for (std::size_t b = 0; b < a; ++b) {
      if (lattice.count[b] < 2) continue;
      for (const int sign : {1, -1}) {
        std::array<int, 3> diagonal = along;
        diagonal[b] = sign;
        add_line(diagonal, sign * entry(b) / 2, stencil);
      }
    }
  }
  return stencil;
}

double largest_rate(const LatticeStencil& stencil) {
  constexpr int waves = 16;  // along an axis; the largest rates are those of the shortest waves, or near them
  constexpr double step = std::numbers::pi / waves;
  double largest = 0;
  // Waves and their opposites are one.
  for (int i = 0; i <= waves; ++i)
    for (int j = -waves; j <= waves; ++j)
      for (int k = -waves; k <= waves; ++k) {
        double rate = 0;
        for (const auto& [to, weight] : stencil.neighbours)
          rate += 2 * weight * (1 - std::cos(step * (i * to[0] + j * to[1] + k * to[2])));
        largest = std::max(largest, rate);
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
