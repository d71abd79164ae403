#include "base/random.h"

#include <algorithm>
#include <cmath>

#include "base/checked.h"

namespace pelage {

namespace {

/// The four values of the uniform cubic B-spline that are non-zero at offset t in [0, 1).
std::array<double, 4> cubic_bspline(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * (t - 2) + 4) / 6, (3 * s * s * (s - 2) + 4) / 6, t * t * t / 6};
}

/// Uniform in [-1, 1) for a lattice point.
double lattice_value(std::int64_t i, std::int64_t j, std::int64_t k, std::uint64_t seed) {
  const std::uint64_t row = hash(hash(seed, static_cast<std::uint64_t>(i)), static_cast<std::uint64_t>(j));
  return 2 * uniform(row, static_cast<std::uint64_t>(k)) - 1;
}

/// From 0 to n - 1.
std::int64_t modulo(std::int64_t i, std::int64_t n) { return ((i % n) + n) % n; }

constexpr double furthest = 0x1p62;  // lattice points beyond have no numbers

}  // namespace

std::uint64_t place_seed(const std::array<double, 3>& place, double length, std::uint64_t seed) {
  constexpr double cells = 1024;
  constexpr double between = 0.3183;  // of the walls of cells: simple fractions of a length are well inside
  for (const double x : place)
    seed = hash(seed, static_cast<std::uint64_t>(saturated<std::int64_t>(std::floor(x / length * cells + between))));
  return seed;
}

double smooth_noise(const std::array<double, 3>& place, double length, std::uint64_t seed,
                    const std::array<double, 3>& period) {
  std::array<std::array<std::int64_t, 4>, 3> cell{};
  std::array<std::array<double, 4>, 3> weight{};
  for (std::size_t d = 0; d < 3; ++d) {
    const double cells = period[d] > 0 ? std::clamp(std::round(period[d] / length), 1.0, furthest) : 0;
    const double x = place[d] / (cells > 0 ? period[d] / cells : length);
    const double floor = std::floor(x);
    const auto first = saturated<std::int64_t>(std::clamp(floor, -furthest, furthest)) - 1;
    for (std::int64_t i = 0; i < 4; ++i)
      cell[d][static_cast<std::size_t>(i)] =
          cells > 0 ? modulo(first + i, static_cast<std::int64_t>(cells)) : first + i;
    weight[d] = cubic_bspline(x - floor);
  }
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        sum += weight[0][i] * weight[1][j] * weight[2][k] * lattice_value(cell[0][i], cell[1][j], cell[2][k], seed);
  // Variance of the sum, averaged over a cell: (1/3) * c^3 with c = integral of the squared B-spline = 151/315.
  constexpr double mean_square = 151.0 / 315.0;
  static const double scale = std::sqrt(3 / (mean_square * mean_square * mean_square));
  return scale * sum;
}

}  // namespace pelage
