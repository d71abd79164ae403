#include "time/chebyshev.h"

#include <algorithm>
#include <cmath>

namespace pelage {

namespace {

/// How far the stability polynomial stays below 1 inside of its interval.
constexpr double damping = 2.0 / 13;

/// A Chebyshev polynomial of the first kind and its derivatives at w0.
struct ChebyshevValue {
  double value, first, second;
};

std::vector<ChebyshevValue> chebyshev_values(int s, double w0) {
  std::vector<ChebyshevValue> t = {{1, 0, 0}, {w0, 1, 0}};
  for (int j = 2; j <= s; ++j) {
    const ChebyshevValue &a = t[t.size() - 1], &b = t[t.size() - 2];
    t.push_back({2 * w0 * a.value - b.value, 2 * a.value + 2 * w0 * a.first - b.first,
                 4 * a.first + 2 * w0 * a.second - b.second});
  }
  return t;
}

}  // namespace

std::vector<ChebyshevStage> chebyshev_stages(int s) {
  const auto n = static_cast<std::size_t>(s);
  const double w0 = 1 + damping / (static_cast<double>(s) * s);
  const std::vector<ChebyshevValue> t = chebyshev_values(s, w0);
  const double w1 = t[n].first / t[n].second;
  std::vector<double> b(n + 1);
  for (std::size_t j = 2; j <= n; ++j) b[j] = t[j].second / (t[j].first * t[j].first);
  b[0] = b[1] = b[2];
  std::vector<ChebyshevStage> stages(n + 1);
  for (std::size_t j = 2; j <= n; ++j) {
    ChebyshevStage& stage = stages[j];
    stage.mu = 2 * b[j] * w0 / b[j - 1];
    stage.nu = -b[j] / b[j - 2];
    stage.rate = 2 * b[j] * w1 / b[j - 1];
    stage.first = -(1 - b[j - 1] * t[j - 1].value) * stage.rate;
    stage.time = w1 * t[j].second / t[j].first;
  }
  stages[1].rate = b[1] * w1;
  stages[1].time = stages[2].time / t[2].first;
  return stages;
}

/// The interval ends at 2/3 (s^2 - 1) (1 - 2/15 damping).
int chebyshev_stage_count(double stiffness) {
  return std::max(2, 1 + static_cast<int>(std::sqrt(1 + 1.54 * stiffness)));
}

}  // namespace pelage
