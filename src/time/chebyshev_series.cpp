#include "time/chebyshev_series.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace pelage {

namespace {

using std::numbers::pi;

/// The polynomials are at most 1 where eigenvalues are; lengths, though, are only nearly those in which B is symmetric.
constexpr double most_growth = 30;

/// How many terms are needed so that the rest adds up to no more than the tolerance.
std::size_t terms_for(const ChebyshevSeries& series, double tolerance) {
  double rest = 0;
  std::size_t count = series.size();
  while (count > 1 && rest + std::abs(series[count - 1]) <= tolerance) rest += std::abs(series[--count]);
  return count;
}

}  // namespace

/// The coefficients of exp(-x) fall like exp(-k^2 / end), once like the terms of its power series.
std::vector<double> chebyshev_points(double end) {
  constexpr double of_digits = 6.1, few = 24;  // 6.1^2 = 37 = -ln(1e-16)
  const auto count = static_cast<std::size_t>(few + of_digits * std::sqrt(std::max(0.0, end)));
  std::vector<double> points(count);
  for (std::size_t j = 0; j < count; ++j)
    points[j] = end / 2 * (1 + std::cos(pi * (static_cast<double>(j) + 0.5) / static_cast<double>(count)));
  return points;
}

ChebyshevSeries chebyshev_series(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> cosine(4 * n);
  for (std::size_t q = 0; q < cosine.size(); ++q)
    cosine[q] = std::cos(pi * static_cast<double>(q) / static_cast<double>(2 * n));
  ChebyshevSeries series(n);
  parallel_for(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += values[j] * cosine[k * (2 * j + 1) % (4 * n)];
      series[k] = sum * (k == 0 ? 1 : 2) / static_cast<double>(n);
    }
  });
  return series;
}

int add_series(const DiffusionOperator& b, const Vector& v, std::span<const SeriesSum> sums, double tolerance) {
  const double length = b.length(v), end = b.radius();
  if (length == 0) return 0;
  if (!std::isfinite(length)) {  // for those to see who look at the sums
    for (const SeriesSum& s : sums) *s.sum += v;
    return 0;
  }
  std::size_t terms = 1;
  for (const SeriesSum& s : sums) terms = std::max(terms, terms_for(*s.series, tolerance / length));
  Vector before, now = v, next;
  for (std::size_t k = 0;; ++k) {
    for (const SeriesSum& s : sums)
      if (k < s.series->size()) axpby((*s.series)[k], now, 1, *s.sum);
    if (k + 1 == terms) return static_cast<int>(k);
    // T_1 = x T_0, and then T_(k+1) = 2 x T_k - T_(k-1), with x = 2 B / end - 1.
    b.apply(now, next);
    const double twice = k == 0 ? 1 : 2;
    axpby(-twice, now, end > 0 ? 2 * twice / end : 0, next);
    if (k > 0) axpby(-1, before, 1, next);
    if (!(b.length(next) <= most_growth * length)) return -1;
    std::swap(before, now);
    std::swap(now, next);
  }
}

}  // namespace pelage
