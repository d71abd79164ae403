#include "react/stability.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/dense.h"
#include "base/random.h"

namespace pelage {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Schur complement of a matrix on the indices that are kept.
MatrixXd eliminated(const MatrixXd& a, const std::vector<Eigen::Index>& keep, const std::vector<Eigen::Index>& drop) {
  if (drop.empty()) return a;
  const MatrixXd inner = a(drop, drop), right = a(drop, keep);
  return a(keep, keep) - a(keep, drop) * solved(inner, right);
}

/// Expressions of the species alone, to be evaluated again and again: everything that depends on the place is at its
/// mean.
class PointFormulas {
 public:
  PointFormulas(const Graph& graph, const std::vector<NodeId>& roots) {
    std::vector<int> slot(graph.size(), nowhere);
    for (const NodeId id : reachable(graph, roots)) {
      slot[static_cast<std::size_t>(id)] = static_cast<int>(steps_.size());
      const Node& node = graph[id];
      Step step{node.op, node.value, nowhere, {}};
      for (std::size_t k = 0; k < step.in.size(); ++k)
        step.in[k] = node.in[k] < 0 ? nowhere : slot[static_cast<std::size_t>(node.in[k])];
      if (node.op == Op::symbol) take(graph.symbol_of(id), step);
      steps_.push_back(step);
    }
    for (const NodeId root : roots) results_.push_back(slot[static_cast<std::size_t>(root)]);
  }

  VectorXd operator()(const VectorXd& u) const {
    std::vector<double> value(steps_.size());
    const auto in = [&](int slot) { return slot == nowhere ? 0.0 : value[static_cast<std::size_t>(slot)]; };
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const Step& s = steps_[i];
      if (s.op == Op::constant)
        value[i] = s.species == nowhere ? s.constant : u[s.species];
      else
        value[i] = apply(s.op, in(s.in[0]), in(s.in[1]), in(s.in[2]));
    }
    VectorXd result(std::ssize(results_));
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = in(results_[static_cast<std::size_t>(i)]);
    return result;
  }

 private:
  static constexpr int nowhere = -1;
  struct Step {
    Op op;
    double constant;
    int species;  ///< whose concentration it is, instead of the constant
    std::array<int, 3> in;
  };

  static void take(const Symbol& symbol, Step& step) {
    step.op = Op::constant;
    step.constant = symbol.kind == Symbol::Kind::uniform ? 0.5 : 0.0;
    if (symbol.kind == Symbol::Kind::species) step.species = symbol.index;
  }

  std::vector<Step> steps_;
  std::vector<int> results_;
};

/// The equations at one point, everything that depends on the place being at its mean.
class PointSystem {
 public:
  explicit PointSystem(const Model& model)
      : equations_(model.equations()),
        size_(model.species_count()),
        rate_(equations_.graph, equations_.rate),
        jacobian_(equations_.graph, equations_.jacobian) {
    for (std::size_t i = 0; i < size_; ++i)
      (model.algebraic(i) ? algebraic_ : evolving_).push_back(static_cast<Eigen::Index>(i));
  }

  const std::vector<Eigen::Index>& evolving() const { return evolving_; }
  /// All species from the evolving ones, where nothing varies in space.
  VectorXd complete(const VectorXd& evolving) const {
    VectorXd u = VectorXd::Zero(static_cast<Eigen::Index>(size_));
    u(evolving_) = evolving;
    if (!algebraic_.empty()) u(algebraic_) = rate_(u)(algebraic_).eval();
    return u;
  }
  /// Rates of the evolving species.
  VectorXd rate(const VectorXd& u) const { return rate_(u)(evolving_); }
  VectorXd initial() const {
    const VectorXd all = vector(equations_.initial, VectorXd::Zero(static_cast<Eigen::Index>(size_)));
    return complete(all(evolving_));
  }
  /// Of all species; the R of an algebraic one is its formula minus itself.
  MatrixXd jacobian(const VectorXd& u) const {
    const auto n = static_cast<Eigen::Index>(size_);
    MatrixXd j = jacobian_(u).reshaped<Eigen::RowMajor>(n, n);
    for (const Eigen::Index a : algebraic_) j(a, a) -= 1;
    return j;
  }
  /// Of the evolving species alone.
  MatrixXd reduced_jacobian(const VectorXd& u) const { return eliminated(jacobian(u), evolving_, algebraic_); }
  VectorXd diffusion(const VectorXd& u) const {
    return vector(equations_.prefactor, u).cwiseProduct(vector(equations_.diffusion, u));
  }
  /// At [i * species + j], empty if there is none.
  std::vector<double> fluxes(const VectorXd& u) const {
    std::vector<double> values(equations_.fluxes.empty() ? 0 : size_ * size_);
    for (const Flux& flux : equations_.fluxes)
      values[flux.species * size_ + flux.of] = vector({flux.coefficient}, u)[0];
    return values;
  }
  bool within_bounds(const VectorXd& u) const {
    for (std::size_t i = 0; i < size_; ++i) {
      const double value = u[static_cast<Eigen::Index>(i)], slack = 1e-9 * (1 + std::fabs(value));
      if (value < equations_.lower[i] - slack || value > equations_.upper[i] + slack) return false;
    }
    return true;
  }

 private:
  VectorXd vector(const std::vector<NodeId>& roots, const VectorXd& u) const {
    return PointFormulas(equations_.graph, roots)(u);
  }

  const Equations& equations_;
  const std::size_t size_;
  const PointFormulas rate_, jacobian_;
  std::vector<Eigen::Index> evolving_, algebraic_;
};

/// Newton's method with halved steps while the residual does not fall. The pseudo-inverse lets it converge to a
/// point of a line of steady states too (conserved quantities make the Jacobian singular there).
std::optional<VectorXd> steady_state_from(const PointSystem& system, VectorXd u) {
  const auto& evolving = system.evolving();
  VectorXd rate = system.rate(u);
  for (int iteration = 0; iteration < 60 && rate.allFinite(); ++iteration) {
    const MatrixXd jacobian = system.reduced_jacobian(u);
    if (!jacobian.allFinite()) return std::nullopt;
    const VectorXd step = least_squares(jacobian, rate);
    const double size = 1e-3 + u.norm();
    // Where the Jacobian is singular, steps also end where rates are smallest without being 0.
    const auto rests = [&](double share) { return rate.norm() <= share * jacobian.norm() * size; };
    if (step.norm() <= 1e-13 * size) return rests(1e-9) ? std::optional(u) : std::nullopt;
    double length = 1;
    VectorXd next = system.complete(u(evolving) - step);
    VectorXd next_rate = system.rate(next);
    while (length > 1e-4 && !(next_rate.norm() < rate.norm())) {
      length /= 2;
      next = system.complete(u(evolving) - length * step);
      next_rate = system.rate(next);
    }
    if (!next_rate.allFinite()) return std::nullopt;
    if (!(next_rate.norm() < rate.norm()))
      return step.norm() <= 1e-7 * size && rests(1e-7) ? std::optional(u) : std::nullopt;
    u = next;
    rate = next_rate;
  }
  return std::nullopt;
}

/// The mean initial values, and points spread over four orders of magnitude in every orthant.
std::vector<VectorXd> starting_points(const PointSystem& system) {
  constexpr std::uint64_t seed = 1;  // any: the points only have to be spread out
  constexpr int count = 300;
  const auto n = std::ssize(system.evolving());
  std::vector<VectorXd> starts = {system.initial(), system.complete(VectorXd::Zero(n)),
                                  system.complete(VectorXd::Ones(n))};
  for (int k = 0; k < count; ++k) {
    VectorXd u(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto counter =
          static_cast<std::uint64_t>(k) * system.evolving().size() * 2 + static_cast<std::uint64_t>(2 * i);
      const double magnitude = std::pow(10.0, 4 * uniform(seed, counter) - 2.5);
      // Concentrations are mostly positive; every fourth start also looks elsewhere.
      u[i] = k % 4 == 0 && uniform(seed, counter + 1) < 0.5 ? -magnitude : magnitude;
    }
    starts.push_back(system.complete(u));
  }
  return starts;
}

std::vector<VectorXd> find_steady_states(const PointSystem& system) {
  constexpr std::size_t most = 64;  // a line of steady states would give one per start
  std::vector<VectorXd> states;
  for (const VectorXd& start : starting_points(system)) {
    const auto state = start.allFinite() ? steady_state_from(system, start) : std::nullopt;
    if (!state || !system.within_bounds(*state) || states.size() == most) continue;
    const auto same = [&](const VectorXd& other) { return (other - *state).norm() <= 1e-6 * (1e-3 + state->norm()); };
    if (std::ranges::none_of(states, same)) states.push_back(*state);
  }
  return states;
}

MatrixXd square(const std::vector<double>& by_row, Eigen::Index n) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(by_row.data(), n, n);
}

MatrixXd jacobian_of(const Stability& stability) {
  return square(stability.jacobian, static_cast<Eigen::Index>(stability.diffusion.size()));
}

/// J - k^2 D of the evolving species.
MatrixXd evolution(const Stability& stability, double k2) {
  MatrixXd matrix = jacobian_of(stability);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    matrix(i, i) -= k2 * stability.diffusion[static_cast<std::size_t>(i)];
  if (!stability.fluxes.empty()) matrix -= k2 * square(stability.fluxes, matrix.rows());
  if (stability.cross.empty()) return matrix;
  matrix -= k2 * square(stability.cross, matrix.rows());
  std::vector<Eigen::Index> evolving, algebraic;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    (stability.algebraic[static_cast<std::size_t>(i)] ? algebraic : evolving).push_back(i);
  return eliminated(matrix, evolving, algebraic);
}

std::vector<std::complex<double>> sorted_eigenvalues(const MatrixXd& matrix) {
  const Eigen::VectorXcd values = eigenvalues(matrix);
  std::vector<std::complex<double>> list(values.begin(), values.end());
  std::ranges::sort(list,
                    [](auto a, auto b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
  return list;
}

/// Growth as a function of log k, sampled, with its maxima refined.
class Dispersion {
 public:
  explicit Dispersion(const Stability& stability) : stability_(stability) {
    std::vector<double> diffusions;
    for (const auto* list : {&stability.diffusion, &stability.cross, &stability.fluxes})
      for (const double d : *list) diffusions.push_back(std::fabs(d));
    const double fastest = *std::ranges::max_element(diffusions);
    const double slowest = smallest_positive(diffusions);
    scale_ = jacobian_of(stability).norm();
    if (!std::isfinite(fastest) || !(slowest > 0) || !(scale_ > 0)) return;
    // Diffusion over one wavelength is as fast as the reaction between these two wave numbers; three more
    // decades on either side leave nothing out.
    low_ = std::log(1e-3 * std::sqrt(scale_ / fastest));
    high_ = std::log(1e3 * std::sqrt(scale_ / slowest));
    for (int i = 0; i <= intervals; ++i) samples_.push_back(growth(at(i)));
  }

  bool empty() const { return samples_.empty(); }
  double growth(double log_k) const { return growth_rate(stability_, std::exp(log_k)).real(); }
  /// Growth rates smaller than this are rounding.
  double noise() const { return 1e-10 * scale_; }

  /// log k of the highest maximum that has lower growth on both sides.
  std::optional<double> highest_maximum() const {
    std::optional<int> best;
    for (int i = 1; i < intervals; ++i)
      if (is_peak(i) && (!best || sample(i) > sample(*best))) best = i;
    if (!best) return std::nullopt;
    return refine(at(*best - 1), at(*best + 1));
  }

  /// Growth changes its sign between log k = peak and the end of the range on one side, or that end.
  double edge_of_band(double peak, bool upwards) const {
    const double width = (high_ - low_) / intervals;
    double inside = peak, outside = peak;
    do {
      inside = outside;
      outside += upwards ? width : -width;
      if (outside < low_ || outside > high_) return upwards ? high_ : low_;
    } while (growth(outside) > 0);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (growth(middle) > 0 ? inside : outside) = middle;
    }
    return inside;
  }

 private:
  static constexpr int intervals = 3000;  // 0.6 % in k for diffusion ratios up to 1e4

  static double smallest_positive(const std::vector<double>& values) {
    double result = 0;
    for (const double value : values)
      if (value > 0 && (result == 0 || value < result)) result = value;
    return result;
  }
  double at(int i) const { return low_ + (high_ - low_) * i / intervals; }
  double sample(int i) const { return samples_[static_cast<std::size_t>(i)]; }

  /// A maximum that stands out of the rounding errors of a plateau on both sides.
  bool is_peak(int i) const {
    if (!(sample(i) >= sample(i - 1) && sample(i) >= sample(i + 1))) return false;
    const auto middle = samples_.begin() + i;
    const double left = *std::min_element(samples_.begin(), middle), right = *std::min_element(middle, samples_.end());
    return sample(i) > std::max(left, right) + noise();
  }

  double refine(double a, double b) const {  // golden section
    constexpr double ratio = 0.61803398874989484820;
    double c = b - ratio * (b - a), d = a + ratio * (b - a);
    double fc = growth(c), fd = growth(d);
    while (b - a > 1e-12) {
      if (fc > fd) {
        b = d, d = c, fd = fc;
        c = b - ratio * (b - a);
        fc = growth(c);
      } else {
        a = c, c = d, fc = fd;
        d = a + ratio * (b - a);
        fd = growth(d);
      }
    }
    return 0.5 * (a + b);
  }

  const Stability& stability_;
  double low_ = 0, high_ = 0, scale_ = 0;
  std::vector<double> samples_;
};

void analyse_dispersion(Stability& stability) {
  stability.growth = stability.eigenvalues.front().real();
  stability.oscillatory = stability.eigenvalues.front().imag() != 0;
  const Dispersion dispersion(stability);
  if (dispersion.empty()) return;
  const auto peak = dispersion.highest_maximum();
  if (!peak) return;
  const std::complex<double> sigma = growth_rate(stability, std::exp(*peak));
  // A damped maximum below the growth of the uniform state (a Hopf mode, say) shapes no pattern.
  if (sigma.real() < -dispersion.noise() && sigma.real() < stability.growth) return;
  stability.wavelength = 2 * std::numbers::pi / std::exp(*peak);
  stability.growth = sigma.real();
  stability.oscillatory = sigma.imag() != 0;
  if (sigma.real() <= dispersion.noise()) return;
  stability.band_min = std::exp(dispersion.edge_of_band(*peak, false));
  stability.band_max = std::exp(dispersion.edge_of_band(*peak, true));
}

}  // namespace

Stability analyse(const Model& model) {
  const PointSystem system(model);
  const std::vector<VectorXd> states = find_steady_states(system);
  if (states.empty()) return {};
  const VectorXd initial = system.initial();
  const auto distance = [&](const VectorXd& state) { return (state - initial).norm(); };
  const auto nearest = std::ranges::min_element(states, {}, distance);
  Stability result = analyse_at(model, {nearest->begin(), nearest->end()});
  result.steady_states.clear();
  for (const VectorXd& state : states) result.steady_states.emplace_back(state.begin(), state.end());
  result.chosen = static_cast<std::size_t>(nearest - states.begin());
  return result;
}

Stability analyse_at(const Model& model, const std::vector<double>& steady_state) {
  const PointSystem system(model);
  const VectorXd state = Eigen::Map<const VectorXd>(steady_state.data(), std::ssize(steady_state));
  Stability result;
  result.steady_states = {steady_state};
  const MatrixXd jacobian = system.jacobian(state);
  const VectorXd diffusion = system.diffusion(state);
  const auto by_row = jacobian.reshaped<Eigen::RowMajor>();
  result.jacobian.assign(by_row.begin(), by_row.end());
  result.diffusion.assign(diffusion.begin(), diffusion.end());
  result.fluxes = system.fluxes(state);
  if (!model.coupled().empty()) {
    result.cross = model.equations().cross;
    result.algebraic = model.equations().algebraic;
  }
  result.eigenvalues = sorted_eigenvalues(evolution(result, 0));
  analyse_dispersion(result);
  return result;
}

std::complex<double> growth_rate(const Stability& stability, double wave_number) {
  return sorted_eigenvalues(evolution(stability, wave_number * wave_number)).front();
}

}  // namespace pelage
