#include "gridgen/minimise.h"

#include <cmath>
#include <deque>

#include "base/parallel.h"

namespace pelage {

namespace {

/// Pairs of steps and changes of the gradient that are remembered; more did not save iterations on grids.
constexpr std::size_t memory = 12;

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return ordered_sum(a.size(), 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}

/// y += a x.
void add(double a, const std::vector<double>& x, std::vector<double>& y) {
  parallel_for(x.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] += a * x[i];
  });
}

struct Pair {
  std::vector<double> s, y;
  double sy;
};

/// -H g by the two loops over the pairs.
std::vector<double> direction(const std::deque<Pair>& pairs, const std::vector<double>& gradient) {
  std::vector<double> d = gradient;
  std::vector<double> alpha(pairs.size());
  for (std::size_t k = pairs.size(); k-- > 0;) {
    alpha[k] = product(pairs[k].s, d) / pairs[k].sy;
    add(-alpha[k], pairs[k].y, d);
  }
  const double scale = pairs.empty() ? -1 : -pairs.back().sy / product(pairs.back().y, pairs.back().y);
  for (double& value : d) value *= scale;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double beta = product(pairs[k].y, d) / pairs[k].sy;
    add(-alpha[k] - beta, pairs[k].s, d);
  }
  return d;
}

class Descent {
 public:
  Descent(const Objective& objective, std::vector<double>& x) : objective_(objective), x_(x), gradient_(x.size()) {
    value_ = objective_(x_, gradient_);
  }

  double value() const { return value_; }

  /// One step downhill; false where none is found.
  bool step() {
    std::vector<double> d = direction(pairs_, gradient_);
    double slope = product(gradient_, d);
    if (!(slope < 0)) {
      if (pairs_.empty()) return false;
      pairs_.clear();
      d = direction(pairs_, gradient_);
      slope = product(gradient_, d);
    }
    // Without a memory nothing says how long a step is: one that would take away a tenth of the value.
    const double first = pairs_.empty() ? std::min(1.0, 0.1 * std::abs(value_) / -slope) : 1;
    if (search(d, slope, first)) return true;
    if (pairs_.empty()) return false;
    pairs_.clear();
    return step();
  }

 private:
  /// Armijo's rule by halving, with the minimum of a parabola where that is shorter.
  bool search(const std::vector<double>& d, double slope, double t) {
    constexpr double share = 1e-4, least = 1e-12;
    std::vector<double> place, gradient(x_.size());
    for (; t > least;) {
      place = x_;
      add(t, d, place);
      const double value = objective_(place, gradient);
      if (std::isfinite(value) && value <= value_ + share * t * slope) {
        remember(place, gradient);
        x_ = std::move(place);
        gradient_ = std::move(gradient);
        value_ = value;
        return true;
      }
      const double parabola = std::isfinite(value) ? -slope * t * t / (2 * (value - value_ - slope * t)) : 0;
      t = parabola > 0.1 * t && parabola < 0.5 * t ? parabola : 0.5 * t;
    }
    return false;
  }

  /// Pairs of negative curvature would spoil the matrix and are left out.
  void remember(const std::vector<double>& place, const std::vector<double>& gradient) {
    Pair pair{place, gradient, 0};
    add(-1, x_, pair.s);
    add(-1, gradient_, pair.y);
    pair.sy = product(pair.s, pair.y);
    if (!(pair.sy > 1e-10 * std::sqrt(product(pair.s, pair.s) * product(pair.y, pair.y)))) return;
    if (pairs_.size() == memory) pairs_.pop_front();
    pairs_.push_back(std::move(pair));
  }

  const Objective& objective_;
  std::vector<double>& x_;
  std::vector<double> gradient_;
  double value_ = 0;
  std::deque<Pair> pairs_;
};

}  // namespace

Minimum minimise(const Objective& objective, std::vector<double>& x, const MinimiseOptions& options) {
  Descent descent(objective, x);
  Minimum result{descent.value(), 0, false};
  std::deque<double> values = {result.value};
  while (!result.converged && result.iterations < options.most_iterations) {
    if (!descent.step()) {
      result.converged = true;
      break;
    }
    ++result.iterations;
    result.value = descent.value();
    values.push_back(result.value);
    if (values.size() <= static_cast<std::size_t>(options.window)) continue;
    result.converged = values.front() - result.value <= options.tolerance * std::abs(result.value);
    values.pop_front();
  }
  return result;
}

}  // namespace pelage
