#include "verify/sphere_spectrum.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace pelage {

namespace {

/// Calls visit(l, P) for l = m .. max_degree with the associated Legendre functions of cosine and sine, normalised so
/// that P exp(i m phi) has norm 1 on the sphere; without the factor (-1)^m. `diagonal` is P for l = m.
template <class Visit>
void for_each_degree(int m, int max_degree, double cosine, double diagonal, Visit visit) {
  double before = 0, now = diagonal;
  for (int l = m; l <= max_degree; ++l) {
    visit(l, now);
    const double square = static_cast<double>(l) * l, next_square = (l + 1.0) * (l + 1.0), m_square = 1.0 * m * m;
    const double a = std::sqrt((4 * next_square - 1) / (next_square - m_square));
    const double b = std::sqrt((square - m_square) / (4 * square - 1));
    const double next = a * (cosine * now - b * before);
    before = now;
    now = next;
  }
}

}  // namespace

std::vector<double> power_by_degree(const std::vector<Point>& place, const Vector& weight, const Vector& value,
                                    int max_degree) {
  const auto degrees = static_cast<std::size_t>(max_degree) + 1;
  std::vector<std::complex<double>> coefficient(degrees * degrees);  // of degree l and order m >= 0 at l * degrees + m
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto [x, y, z] = place[i];
    const double factor = weight[static_cast<Eigen::Index>(i)] * value[static_cast<Eigen::Index>(i)];
    const std::complex<double> equatorial(x, y);                            // sin(theta) exp(i phi)
    std::complex<double> diagonal = std::sqrt(1 / (4 * std::numbers::pi));  // P_mm exp(i m phi)
    for (int m = 0; m <= max_degree; ++m) {
      // The recurrence is linear, so it may start from 1 and the phase be put in afterwards.
      for_each_degree(m, max_degree, z, factor, [&](int l, double p) {
        coefficient[static_cast<std::size_t>(l) * degrees + static_cast<std::size_t>(m)] += p * diagonal;
      });
      diagonal *= equatorial * std::sqrt((2.0 * m + 3) / (2.0 * m + 2));
    }
  }
  std::vector<double> power(degrees, 0.0);
  for (std::size_t l = 0; l < degrees; ++l)
    for (std::size_t m = 0; m <= l; ++m)  // orders m and -m together
      power[l] += (m == 0 ? 1 : 2) * std::norm(coefficient[l * degrees + m]);
  return power;
}

}  // namespace pelage
