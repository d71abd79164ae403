#include "time/rkc2.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "base/dense.h"
#include "base/parallel.h"
#include "time/chebyshev.h"
#include "time/explicit_gradients.h"
#include "time/species_pairs.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// Nodes that are worked on together, so that all their numbers stay in the L1 cache.
constexpr std::size_t block_nodes = 256;
/// Nodes per piece of parallel work.
constexpr std::size_t piece_nodes = 4 * block_nodes;
/// The Jacobian of the reaction is looked at in so many nodes of every block; on a tile in all of them, because there
/// no node is before others.
constexpr std::size_t probed_share = 64;

/// Rounding grows with the square of the number of stages, 6e-8 s^2 of the change in a step; a step that needs more of
/// them is made of several.
constexpr int most_stages = 100;

/// Sums in another order end in other bits, which then make another step: on a tile, where no node is the first, a few
/// bits of the error are enough to choose one by.
double without_order(double error) {
  constexpr double parts = 16;
  int exponent = 0;
  const double mantissa = std::frexp(error, &exponent);
  return std::isfinite(error) ? std::ldexp(std::round(parts * mantissa) / parts, exponent) : error;
}

/// Values that no concentration reaches but by blowing up, see advance().
constexpr double largest_value = 1e30;
/// Smaller values become 0, well above the smallest float, and fields that are not much larger count for nothing.
constexpr double smallest_value = 1e-30, small_field = 1e-27;

/// The power iteration finds the largest eigenvalue from below, and the Jacobian is that of the start of the step.
constexpr double radius_margin = 1.05, jacobian_margin = 1.2;

std::size_t slices_below(std::size_t nodes) { return padded(nodes) / slice_rows; }

/// A function of time at all nodes: one field per pair.
using Fields = std::vector<PairField>;

/// Per species: sums of the squares of error and value.
struct RateSums {
  std::vector<double> error, size;
  explicit RateSums(std::size_t species = 0) : error(species), size(species) {}
  RateSums& operator+=(const RateSums& o) {
    for (std::size_t i = 0; i < error.size(); ++i) {
      error[i] += o.error[i];
      size[i] += o.size[i];
    }
    return *this;
  }
};

/// The spectral radius of a matrix without negative entries; infinite where one is no number.
double nonnegative_radius(const Eigen::MatrixXd& a) {
  return a.allFinite() ? eigenvalues(a).cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity();
}

/// Memory for the blocks of one piece of work.
class BlockWork {
 public:
  BlockWork(std::size_t pairs, std::size_t species, std::size_t gradients)
      : memory_(std::make_unique_for_overwrite<float[]>((8 * pairs + 1) * block_nodes)),
        pointers_(6 * pairs + species),
        in_(species + gradients),
        pairs_(pairs) {
    for (std::size_t k = 0; k < 6 * pairs; ++k) pointers_[k] = memory_.get() + k * block_nodes;
    std::fill_n(unused(), block_nodes, 0.0f);
  }
  /// Fields by 2 pair + lane: values, rates, and other rates.
  std::span<float* const> u() const { return std::span(pointers_).first(2 * pairs_); }
  std::span<float* const> rate() const { return std::span(pointers_).subspan(2 * pairs_, 2 * pairs_); }
  std::span<float* const> other() const { return std::span(pointers_).subspan(4 * pairs_, 2 * pairs_); }
  float* product(std::size_t pair) { return memory_.get() + (6 * pairs_ + 2 * pair) * block_nodes; }
  /// Of species that are not worked on.
  float* unused() { return memory_.get() + 8 * pairs_ * block_nodes; }
  /// Room for one pointer per species, and then one per product of gradients.
  std::span<const float*> in() { return in_; }
  std::span<float*> out() { return std::span(pointers_).subspan(6 * pairs_); }

 private:
  std::unique_ptr<float[]> memory_;
  std::vector<float*> pointers_;
  std::vector<const float*> in_;
  std::size_t pairs_;
};

/// u^(n+1) = u^n + d, where d comes of s stages, each an explicit evaluation of
///   f(u, t) = (I + E + ... + E^m) (-L^-1 D K u) + R(u, t),   E = I - L^-1 M,
/// with the row sums L of the mass M: the sum is the inverse of L^-1 M cut off after m sweeps, and as 1'L E = 0 it
/// moves no amount. Fluxes are treated like the diffusion, in double precision as are the products of gradients in R.
/// The number of stages follows the stiffness, so that every step is stable. Stages are made for the difference d,
/// which is added once, in double precision: single precision then limits what changes in a step, not the field. All
/// that a step depends on is the state, so that a run continues from a checkpoint bit by bit.
class Rkc2 final : public Stepper {
 public:
  explicit Rkc2(const Rkc2Options& options)
      : loops_(&node_loops(options.instructions)),
        pairs_(options.instructions, options.sweeps),
        gradients_(options.sweeps) {}
  StepReport step(const System& system, State& state, const StepRequest& request) override;

 private:
  void bind(const System& system);
  void find_gradients(const System& system, const Fields& y, const Fields* d, double t);
  bool take_over(const State& state, std::size_t first, std::size_t count, BlockWork& work);
  void start_from(const System& system, const State& state);
  bool substep(const System& system, const std::vector<Vector>& now, double t, double dt, const StepRequest& request,
               StepReport& report);
  void first_stage(const std::vector<StageTerms>& terms);
  template <class Set>
  void for_given(const System& system, double t, const Set& set) const;
  void give_values(const System& system, double t, const std::vector<Vector>& now);
  void take_stages(const System& system, const std::vector<Vector>& now, double t, double dt, int s);
  void finish(const System& system, const std::vector<Vector>& now, double dt, StepReport& report);
  RateSums evaluate(const System& system, const Fields& y, double t, const Fields* d, double dt);
  void report_sums(const std::vector<Vector>& now, const std::vector<SpeciesSums>& sums, double dt, StepReport& report);
  Runaway worst(const std::vector<Vector>& now, std::size_t species) const;
  std::vector<ErrorTerms> error_terms(const System& system, double dt) const;
  void add_error(const ErrorTerms& terms, std::size_t pair, const Fields& y, const Fields& d, std::size_t first,
                 std::size_t count, RateSums& sums) const;
  std::vector<float> derivatives(const FloatRates& jacobian, std::size_t first, std::size_t count,
                                 BlockWork& work) const;
  bool may_be_largest(const std::vector<float>& slopes, std::size_t species, std::size_t count);
  void probe(const FloatRates& rates, const FloatRates& jacobian, std::size_t first, std::size_t count,
             BlockWork& work);
  double error_of(const RateSums& sums) const;
  double stiffness() const;

  int before_last(const Fields& x);
  void last_product(std::size_t pair, const Fields& x, std::size_t first, std::size_t last, float* out) const;
  FloatRates rates_at(const System& system, double t);
  void rates_of_block(const FloatRates& rates, std::size_t first, std::size_t count, BlockWork& work,
                      std::span<float* const> rate) const;

  const NodeLoops* loops_;
  std::size_t nodes_ = 0, species_ = 0;
  SpeciesPairs pairs_;
  ExplicitGradients gradients_;
  std::shared_ptr<const Sampling> sampling_;
  bool nodal_ = false;
  std::size_t probed_ = probed_share;  ///< nodes of a block
  float trust_ = 1;                    ///< share of a derivative above which a difference quotient confirms it
  Fields y_, f_, g_, y_next_, f_next_, g_next_, d_, d_before_, product_, swept_;
  std::vector<double> jacobian_, gradient_jacobian_;  ///< of the reaction; of the gradients on the shortest waves
  std::vector<float> largest_;                        ///< entries of the Jacobian as they are found
  std::vector<float> probe_, probe_next_;             ///< by how much species are changed to see the Jacobian
  bool known_ = false;                                ///< f_ belongs to y_ at the time known_time_
  double known_time_ = 0;
  std::vector<Vector> next_, wide_, wide_rates_;
};

void Rkc2::bind(const System& system) {
  const auto nodes = static_cast<std::size_t>(system.sampling->count());
  probed_ = system.mass ? probed_share : block_nodes;
  trust_ = system.mass ? 1 : 0.9f;
  if (!pairs_.update(system) && nodes == nodes_) return;
  known_ = false;
  nodes_ = nodes;
  species_ = system.species.size();
  for (Fields* fields : {&y_, &f_, &g_, &y_next_, &f_next_, &g_next_, &d_, &d_before_}) {
    fields->resize(pairs_.size());
    for (PairField& f : *fields) f.assign(2 * padded(nodes_), 0.0f);
  }
  for (Fields* fields : {&product_, &swept_}) {
    fields->assign(pairs_.size(), {});
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (pairs_.sweeps(p) > 0) (*fields)[p].assign(2 * padded(nodes_), 0.0f);
  }
}

/// Whether y_ was something else at these nodes.
bool Rkc2::take_over(const State& state, std::size_t first, std::size_t count, BlockWork& work) {
  bool changed = false;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    for (float* u : {work.u()[2 * p], work.u()[2 * p + 1]}) std::fill_n(u, block_nodes, 0.0f);
    for (std::size_t k = 0; k < pairs_[p].count; ++k) {
      const double* now = state.now[pairs_[p].species[k]].data() + first;
      std::transform(now, now + count, work.u()[2 * p + k], [](double value) { return static_cast<float>(value); });
    }
    float* const y = y_[p].data() + 2 * first;
    loops_->join(work.u()[2 * p], work.u()[2 * p + 1], count, work.product(p));
    if (std::memcmp(y, work.product(p), 2 * count * sizeof(float)) == 0) continue;
    std::copy_n(work.product(p), 2 * count, y);
    changed = true;
  }
  return changed;
}

/// Takes the state over and finds f there, unless it is known from the step before.
void Rkc2::start_from(const System& system, const State& state) {
  std::vector<char> differs(chunk_count(nodes_, piece_nodes));
  parallel_for(
      nodes_,
      [&](std::size_t begin, std::size_t end) {
        BlockWork work(pairs_.size(), species_, gradients_.products());
        for (std::size_t first = begin; first < end; first += block_nodes)
          if (take_over(state, first, std::min(block_nodes, end - first), work)) differs[begin / piece_nodes] = 1;
      },
      piece_nodes);
  if (known_ && known_time_ == state.time && std::ranges::find(differs, 1) == differs.end()) return;
  probe_.assign(species_, 0);
  for (std::size_t i = 0; i < species_; ++i)
    probe_[i] = static_cast<float>(std::max(std::abs(minimum(state.now[i])), std::abs(maximum(state.now[i]))));
  probe_next_ = probe_;
  evaluate(system, y_, state.time, nullptr, 0);
  jacobian_.assign(largest_.begin(), largest_.end());
  gradient_jacobian_ = gradients_.jacobian(system, state.time);
  std::swap(f_, f_next_);
  std::swap(g_, g_next_);
  known_ = true;
  known_time_ = state.time;
}

/// Of y, or of y + d.
void Rkc2::find_gradients(const System& system, const Fields& y, const Fields* d, double t) {
  if (!system.add_gradients && !system.fluxes) return gradients_.clear();
  std::vector<Vector> u(species_);
  for (const std::size_t i : pairs_.evolving()) {
    u[i].resize(static_cast<Eigen::Index>(nodes_));
    const std::size_t pair = pairs_.place(i) / 2, lane = pairs_.place(i) % 2;
    for (std::size_t k = 0; k < nodes_; ++k)
      u[i][static_cast<Eigen::Index>(k)] =
          static_cast<double>(y[pair][2 * k + lane]) + (d ? static_cast<double>((*d)[pair][2 * k + lane]) : 0);
  }
  gradients_.evaluate(system, std::move(u), t);
}

FloatRates Rkc2::rates_at(const System& system, double t) {
  if (system.reaction.float_rates) return system.reaction.float_rates(t);
  wide_.assign(species_ + gradients_.products(), Vector(static_cast<Eigen::Index>(nodes_)));
  wide_rates_.assign(species_, Vector(static_cast<Eigen::Index>(nodes_)));
  return [this, &system, t](std::span<const float* const> u, std::size_t first, std::size_t count,
                            std::span<float* const> rate) {
    FieldPointers in;
    MutableFieldPointers out;
    for (std::size_t i = 0; i < u.size(); ++i) {
      std::copy(u[i], u[i] + count, wide_[i].data() + first);
      in.push_back(wide_[i].data());
    }
    for (Vector& rates_of : wide_rates_) out.push_back(rates_of.data());
    system.reaction.rates(in, t, first, first + count, out);
    for (std::size_t i = 0; i < species_; ++i)
      std::transform(out[i] + first, out[i] + first + count, rate[i], [](double r) { return static_cast<float>(r); });
  };
}

/// `rate`: two per pair; 0 where nodes are held and where a pair has but one species.
void Rkc2::rates_of_block(const FloatRates& rates, std::size_t first, std::size_t count, BlockWork& work,
                          std::span<float* const> rate) const {
  std::ranges::fill(work.in(), work.unused());  // rates read no species that follows
  std::ranges::fill(work.out(), work.unused());
  for (const std::size_t i : pairs_.evolving()) {
    work.in()[i] = work.u()[pairs_.place(i)];
    work.out()[i] = rate[pairs_.place(i)];
  }
  for (std::size_t k = 0; k < gradients_.products(); ++k) work.in()[species_ + k] = gradients_.product(k) + first;
  rates(work.in(), first, count, work.out());
  for (const std::size_t i : pairs_.evolving())
    if (const float* flux = gradients_.flux(i))
      for (std::size_t k = 0; k < count; ++k) rate[pairs_.place(i)][k] += flux[first + k];
  for (float* r : rate) std::fill(r + count, r + padded(count), 0.0f);
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    if (pairs_[p].count < 2) std::fill_n(rate[2 * p + 1], count, 0.0f);
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    if (const Held* held = pairs_[p].held.get())
      for (std::size_t k = 0; k < count; ++k)
        if ((*held)[first + k]) rate[2 * p][k] = rate[2 * p + 1][k] = 0;
}

/// All products of L^-1 D K x and the sweeps but the last, which belongs to the loop over blocks. A pair without any
/// sweep has but the last.
int Rkc2::before_last(const Fields& x) {
  int most = 0;
  for (std::size_t p = 0; p < pairs_.size(); ++p) most = std::max(most, pairs_.sweeps(p));
  const std::array<float, 2> one = {1, 1};
  for (int pass = 0; pass < most; ++pass)
    parallel_for(
        nodes_,
        [&](std::size_t begin, std::size_t end) {
          const std::size_t first = begin / slice_rows, last = slices_below(end), at = 2 * begin;
          for (std::size_t p = 0; p < pairs_.size(); ++p) {
            if (pass >= pairs_.sweeps(p)) continue;
            const SlicedMatrix& m = *pairs_.matrix(p);
            if (pass == 0)
              loops_->diffuse(m, x[p].data(), pairs_[p].diffusion.data(), first, last, product_[p].data() + at);
            else
              loops_->correct(m, (pass == 1 ? product_ : swept_)[p].data(), product_[p].data() + at, one.data(), first,
                              last, swept_[p].data() + at);
          }
        },
        piece_nodes);
  return most;
}

/// (I + E + ...) (-L^-1 D K x) of the slices of a block.
void Rkc2::last_product(std::size_t p, const Fields& x, std::size_t first, std::size_t last, float* out) const {
  const SlicedMatrix* m = pairs_.matrix(p);
  if (!m) {
    std::fill_n(out, 2 * slice_rows * (last - first), 0.0f);
  } else if (const int sweeps = pairs_.sweeps(p)) {
    const std::array<float, 2> one = {1, 1};
    loops_->correct(*m, (sweeps == 1 ? product_ : swept_)[p].data(), product_[p].data() + 2 * slice_rows * first,
                    one.data(), first, last, out);
  } else {
    loops_->diffuse(*m, x[p].data(), pairs_[p].diffusion.data(), first, last, out);
  }
}

/// Values are divided by the largest, probe_next_.
std::vector<ErrorTerms> Rkc2::error_terms(const System& system, double dt) const {
  std::vector<ErrorTerms> terms(pairs_.size(), {static_cast<float>(0.4 * dt), {0, 0}, {0, 0}, {0, 0}});
  for (const std::size_t i : pairs_.evolving()) {
    ErrorTerms& e = terms[pairs_.place(i) / 2];
    const std::size_t lane = pairs_.place(i) % 2;
    e.lower[lane] = static_cast<float>(system.species[i].lower);
    e.upper[lane] = static_cast<float>(system.species[i].upper);
    e.scale[lane] = 1 / std::max(probe_next_[i], static_cast<float>(small_field));
  }
  return terms;
}

/// f_next_, g_next_ and largest_ at y and t. With the step d that led from y_ to y, also the sums of the error
/// estimate.
RateSums Rkc2::evaluate(const System& system, const Fields& y, double t, const Fields* d, double dt) {
  largest_.assign(species_ * species_, 0.0f);
  before_last(y);
  find_gradients(system, y, nullptr, t);
  const FloatRates rates = rates_at(system, t);
  const FloatRates jacobian = system.reaction.float_jacobian ? system.reaction.float_jacobian(t) : FloatRates{};
  const std::vector<ErrorTerms> terms = error_terms(system, dt);
  const auto partial = [&](std::size_t begin, std::size_t end) {
    RateSums sums(species_);
    BlockWork work(pairs_.size(), species_, gradients_.products());
    for (std::size_t first = begin; first < end; first += block_nodes) {
      const std::size_t count = std::min(block_nodes, end - first), at = 2 * first;
      for (std::size_t p = 0; p < pairs_.size(); ++p)
        loops_->separate(y[p].data() + at, nullptr, count, work.u()[2 * p], work.u()[2 * p + 1]);
      rates_of_block(rates, first, count, work, work.rate());
      for (std::size_t p = 0; p < pairs_.size(); ++p) {
        float* g = g_next_[p].data() + at;
        last_product(p, y, first / slice_rows, slices_below(first + count), g);
        loops_->add_rates(g, work.rate()[2 * p], work.rate()[2 * p + 1], count, f_next_[p].data() + at);
        if (d) add_error(terms[p], p, y, *d, first, count, sums);
      }
      probe(rates, jacobian, first, std::min(probed_, count), work);
    }
    return sums;
  };
  return ordered_sum(nodes_, RateSums(species_), partial, piece_nodes);
}

void Rkc2::add_error(const ErrorTerms& terms, std::size_t p, const Fields& y, const Fields& d, std::size_t first,
                     std::size_t count, RateSums& sums) const {
  std::array<double, 4> sum{};
  const std::size_t at = 2 * first;
  loops_->error(terms, y_[p].data() + at, y[p].data() + at, d[p].data() + at, f_[p].data() + at, f_next_[p].data() + at,
                count, sum.data());
  for (std::size_t k = 0; k < pairs_[p].count; ++k) {
    sums.error[pairs_[p].species[k]] += sum[2 * k];
    sums.size[pairs_[p].species[k]] += sum[2 * k + 1];
  }
}

/// The Jacobian of the reaction at the first nodes of a block whose values are in `work`: dR_i/du_j at node k is at
/// (i * species + j) * probed_ + k; infinite where it is not known.
std::vector<float> Rkc2::derivatives(const FloatRates& jacobian, std::size_t first, std::size_t count,
                                     BlockWork& work) const {
  std::vector<float> values(species_ * species_ * probed_, std::numeric_limits<float>::infinity());
  if (!jacobian) return values;
  std::vector<float*> out(species_ * species_);
  for (std::size_t e = 0; e < out.size(); ++e) out[e] = values.data() + e * probed_;
  jacobian(work.in(), first, count, out);
  return values;
}

/// Whether a derivative by species j is larger at one of these nodes than what has been found elsewhere, in no order:
/// where none is, nothing there counts.
bool Rkc2::may_be_largest(const std::vector<float>& slopes, std::size_t j, std::size_t count) {
  return std::ranges::any_of(pairs_.evolving(), [&](std::size_t i) {
    const float* slope = slopes.data() + (i * species_ + j) * probed_;
    const float found = std::atomic_ref<float>(largest_[i * species_ + j]).load(std::memory_order_relaxed);
    unsigned above = 0;
    for (std::size_t k = 0; k < count; ++k) above |= !(std::abs(slope[k]) <= found);
    return above != 0;
  });
}

/// The largest entries of the Jacobian of the reaction at the first nodes of a block whose values and rates are in
/// `work`. Of derivative and difference quotient the smaller counts: where a rate jumps it has no slope that a step
/// could be too long for, and where a root begins no bounded one. A derivative that is hardly larger counts itself.
void Rkc2::probe(const FloatRates& rates, const FloatRates& jacobian, std::size_t first, std::size_t count,
                 BlockWork& work) {
  const std::vector<float> slopes = derivatives(jacobian, first, count, work);
  for (const std::size_t j : pairs_.evolving()) {
    if (!may_be_largest(slopes, j, count)) continue;
    float* u = work.u()[pairs_.place(j)];
    const float step = probe_next_[j] > 0 ? 0.01f * probe_next_[j] : 1e-3f;
    for (std::size_t k = 0; k < count; ++k) u[k] += step;
    rates_of_block(rates, first, count, work, work.other());
    for (std::size_t k = 0; k < count; ++k) u[k] -= step;
    for (const std::size_t i : pairs_.evolving()) {
      const float *a = work.rate()[pairs_.place(i)], *b = work.other()[pairs_.place(i)];
      const float* slope = slopes.data() + (i * species_ + j) * probed_;
      float largest = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const float quotient = std::abs(b[k] - a[k]) / step;
        const float entry = trust_ * std::abs(slope[k]) < quotient ? std::abs(slope[k]) : quotient;
        largest = entry > largest ? entry : largest;
      }
      std::atomic_ref<float> found(largest_[i * species_ + j]);
      for (float before = found; before < largest && !found.compare_exchange_weak(before, largest);) {
      }
    }
  }
}

/// Relative to the size of the field; one that blows up has none.
double Rkc2::error_of(const RateSums& sums) const {
  double worst = 0;
  for (const std::size_t i : pairs_.evolving()) {
    const double least = probe_next_[i] < small_field ? static_cast<double>(nodes_) : 0;
    const double size = std::max(sums.size[i], least);
    const double error = size > 0 ? std::sqrt(sums.error[i] / size) : 0;
    worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
  }
  return worst;
}

/// A bound of the spectral radius of df/du: on every wave, the moduli of the entries of the matrix of the linearised
/// system are at most those of the matrix here.
double Rkc2::stiffness() const {
  const auto n = static_cast<Eigen::Index>(species_);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd bound = jacobian_margin * Eigen::Map<const RowMajor>(jacobian_.data(), n, n);
  if (!gradient_jacobian_.empty())
    bound += jacobian_margin * Eigen::Map<const RowMajor>(gradient_jacobian_.data(), n, n);
  for (const std::size_t i : pairs_.evolving())
    bound(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += radius_margin * pairs_.radius(i);
  return nonnegative_radius(bound);
}

/// d_ = rate f_0 within the clamps.
void Rkc2::first_stage(const std::vector<StageTerms>& terms) {
  parallel_for(
      nodes_,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
          loops_->first_stage(terms[p], y_[p].data() + 2 * begin, f_[p].data() + 2 * begin, end - begin,
                              d_[p].data() + 2 * begin);
          std::fill_n(d_before_[p].data() + 2 * begin, 2 * (end - begin), 0.0f);
        }
      },
      piece_nodes);
}

/// set(pair, lane, node, value at time t) wherever values are given.
template <class Set>
void Rkc2::for_given(const System& system, double t, const Set& set) const {
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    for (std::size_t lane = 0; lane < pairs_[p].count; ++lane) {
      if (pairs_[p].given[lane].empty()) continue;
      Vector values(static_cast<Eigen::Index>(nodes_));
      system.set_values(pairs_[p].species[lane], t, values);
      for (const std::size_t k : pairs_[p].given[lane]) set(p, lane, k, values[static_cast<Eigen::Index>(k)]);
    }
}

/// Stages are differences from the start of the step, at given values as well.
void Rkc2::give_values(const System& system, double t, const std::vector<Vector>& now) {
  for_given(system, t, [&](std::size_t p, std::size_t lane, std::size_t k, double value) {
    d_[p][2 * k + lane] = static_cast<float>(value - now[pairs_[p].species[lane]][static_cast<Eigen::Index>(k)]);
  });
}

/// d_ = u^(n+1) - u^n.
void Rkc2::take_stages(const System& system, const std::vector<Vector>& now, double t, double dt, int s) {
  const std::vector<ChebyshevStage> stages = chebyshev_stages(s);
  std::vector<StageTerms> terms(pairs_.size());
  for (const std::size_t i : pairs_.evolving()) {
    terms[pairs_.place(i) / 2].lower[pairs_.place(i) % 2] = static_cast<float>(system.species[i].lower);
    terms[pairs_.place(i) / 2].upper[pairs_.place(i) % 2] = static_cast<float>(system.species[i].upper);
  }
  for (StageTerms& of_pair : terms) of_pair.rate = static_cast<float>(stages[1].rate * dt);
  first_stage(terms);
  give_values(system, t + stages[1].time * dt, now);
  for (std::size_t j = 2; j < stages.size(); ++j) {
    const ChebyshevStage& stage = stages[j];
    for (StageTerms& of_pair : terms) {
      of_pair.mu = static_cast<float>(stage.mu);
      of_pair.nu = static_cast<float>(stage.nu);
      of_pair.rate = static_cast<float>(stage.rate * dt);
      of_pair.first = static_cast<float>(stage.first * dt);
    }
    before_last(d_);
    find_gradients(system, y_, &d_, t + stages[j - 1].time * dt);
    const FloatRates rates = rates_at(system, t + stages[j - 1].time * dt);
    parallel_for(
        nodes_,
        [&](std::size_t begin, std::size_t end) {
          BlockWork work(pairs_.size(), species_, gradients_.products());
          for (std::size_t first = begin; first < end; first += block_nodes) {
            const std::size_t count = std::min(block_nodes, end - first), at = 2 * first;
            for (std::size_t p = 0; p < pairs_.size(); ++p)
              loops_->separate(y_[p].data() + at, d_[p].data() + at, count, work.u()[2 * p], work.u()[2 * p + 1]);
            rates_of_block(rates, first, count, work, work.rate());
            for (std::size_t p = 0; p < pairs_.size(); ++p) {
              float* q = work.product(p);
              last_product(p, d_, first / slice_rows, slices_below(first + count), q);
              loops_->stage(terms[p], y_[p].data() + at, d_[p].data() + at, g_[p].data() + at, q, f_[p].data() + at,
                            work.rate()[2 * p], work.rate()[2 * p + 1], count, d_before_[p].data() + at);
            }
          }
        },
        piece_nodes);
    std::swap(d_, d_before_);
    give_values(system, t + stage.time * dt, now);
  }
}

double rounding_of_clamps(const Species& s) {
  double largest = 0;
  for (const double clamp : {s.lower, s.upper})
    if (std::isfinite(clamp)) largest = std::max(largest, std::abs(clamp));
  return largest * std::numeric_limits<float>::epsilon();
}

/// next_ and y_next_ from `now` and d_, and change, minimum and maximum or the failure of the report.
void Rkc2::finish(const System& system, const std::vector<Vector>& now, double dt, StepReport& report) {
  next_.resize(species_);
  std::vector<SpeciesLimits> limits;
  for (std::size_t i = 0; i < species_; ++i) {
    const Species& s = system.species[i];
    if (s.follows)
      next_[i] = now[i];
    else
      next_[i].resize(static_cast<Eigen::Index>(nodes_));
    limits.push_back({s.lower, s.upper, smallest_value, now[i][0], rounding_of_clamps(s)});
  }
  const std::size_t pieces = chunk_count(nodes_, piece_nodes);
  std::vector<SpeciesSums> parts(pieces * species_);
  parallel_chunks(pieces, [&](std::size_t piece) {
    BlockWork work(pairs_.size(), species_, gradients_.products());
    const std::size_t end = std::min(nodes_, (piece + 1) * piece_nodes);
    for (std::size_t first = piece * piece_nodes; first < end; first += block_nodes) {
      const std::size_t count = std::min(block_nodes, end - first);
      for (std::size_t p = 0; p < pairs_.size(); ++p) {
        loops_->separate(d_[p].data() + 2 * first, nullptr, count, work.u()[2 * p], work.u()[2 * p + 1]);
        for (float* y : {work.rate()[2 * p], work.rate()[2 * p + 1]}) std::fill_n(y, block_nodes, 0.0f);
        for (std::size_t k = 0; k < pairs_[p].count; ++k) {
          const std::size_t i = pairs_[p].species[k];
          loops_->finish(limits[i], now[i].data() + first, work.u()[2 * p + k], count, next_[i].data() + first,
                         work.rate()[2 * p + k], parts[piece * species_ + i]);
        }
        loops_->join(work.rate()[2 * p], work.rate()[2 * p + 1], count, y_next_[p].data() + 2 * first);
      }
    }
  });
  std::vector<SpeciesSums> sums(species_);
  for (std::size_t k = 0; k < parts.size(); ++k) sums[k % species_] += parts[k];
  report_sums(now, sums, dt, report);
}

void Rkc2::report_sums(const std::vector<Vector>& now, const std::vector<SpeciesSums>& sums, double dt,
                       StepReport& report) {
  report.minimum = std::numeric_limits<double>::infinity();
  report.maximum = -report.minimum;
  report.change = 0;
  const auto n = static_cast<double>(nodes_);
  for (const std::size_t i : pairs_.evolving()) {
    const SpeciesSums& s = sums[i];
    if (!(s.largest <= largest_value) || !std::isfinite(s.squared_change)) {
      note_runaway(worst(now, i), report);
      return;
    }
    const double variance = std::max(0.0, s.squared_deviation - s.deviation * s.deviation / n);
    const double amplitude = std::max(std::sqrt(variance), small_field * std::sqrt(n));
    if (s.squared_change > 0) report.change = std::max(report.change, std::sqrt(s.squared_change) / (amplitude * dt));
    report.minimum = std::min(report.minimum, s.minimum);
    report.maximum = std::max(report.maximum, s.maximum);
    probe_next_[i] = static_cast<float>(std::max(std::abs(s.minimum), std::abs(s.maximum)));
  }
}

/// The first node where a species is too large or no number.
Runaway Rkc2::worst(const std::vector<Vector>& now, std::size_t i) const {
  const PairField& d = d_[pairs_.place(i) / 2];
  const auto value = [&](std::size_t k) {
    return now[i][static_cast<Eigen::Index>(k)] + static_cast<double>(d[2 * k + pairs_.place(i) % 2]);
  };
  std::size_t k = 0;
  while (k + 1 < nodes_ && std::abs(value(k)) <= largest_value) ++k;
  return {i, k, value(k)};
}

bool Rkc2::substep(const System& system, const std::vector<Vector>& now, double t, double dt,
                   const StepRequest& request, StepReport& report) {
  const int s = chebyshev_stage_count(dt * stiffness());
  take_stages(system, now, t, dt, s);
  // Besides the products: of every pair five arrays are read and one is written in a stage.
  const double fields = 6.0 * 2 * sizeof(float) * static_cast<double>(nodes_ * pairs_.size());
  report.iterations += s;
  report.bytes += s * (pairs_.bytes() + fields);
  finish(system, now, dt, report);
  if (!report.failure.empty()) return false;
  // Given values to the last bit, and no part of the error.
  for_given(system, t + dt, [&](std::size_t p, std::size_t lane, std::size_t k, double value) {
    next_[pairs_[p].species[lane]][static_cast<Eigen::Index>(k)] = value;
    y_next_[p][2 * k + lane] = static_cast<float>(value);
    d_[p][2 * k + lane] = 0;
  });
  const RateSums sums = evaluate(system, y_next_, t + dt, &d_, dt);
  report.error = std::max(report.error, system.mass ? error_of(sums) : without_order(error_of(sums)));
  if (report.error > request.largest_error) return false;
  std::swap(y_, y_next_);
  std::swap(f_, f_next_);
  std::swap(g_, g_next_);
  probe_ = probe_next_;
  jacobian_.assign(largest_.begin(), largest_.end());
  gradient_jacobian_ = gradients_.jacobian(system, t + dt);
  known_time_ = t + dt;
  return true;
}

StepReport Rkc2::step(const System& system, State& state, const StepRequest& request) {
  StepReport report;
  if (sampling_ != system.sampling) {
    sampling_ = system.sampling;
    nodal_ = unknowns_are_samples(*sampling_);
  }
  if (!nodal_ || !system.coupled.index.empty()) {
    report.failure = "the stepper rkc2 needs unknowns that are values at the nodes, and species that are not coupled";
    return report;
  }
  bind(system);
  start_from(system, state);
  const double allowed = (most_stages * most_stages - 1) / 1.54;
  const double parts = std::max(1.0, std::ceil(request.dt * stiffness() / allowed));
  if (!(parts < 1e6)) {
    report.failure = "the fields change so fast that no step is stable";
    return report;
  }
  const std::vector<Vector>* now = &state.now;
  for (int k = 0; k < static_cast<int>(parts); ++k) {
    const double begin = state.time + request.dt * (k / parts), end = state.time + request.dt * ((k + 1) / parts);
    if (!substep(system, *now, begin, end - begin, request, report)) return report;
    now = &next_;
  }
  std::swap(state.now, next_);
  state.time += request.dt;
  known_time_ = state.time;
  ++state.step;
  report.accepted = true;
  return report;
}

/// As many stages as this wave alone needs.
Eigen::MatrixXd amplification(const Linearisation& l, double dt, const Eigen::MatrixXd& decay) {
  const Eigen::MatrixXd z = dt * (l.jacobian - decay);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(z.rows(), z.cols());
  const double stiffness = nonnegative_radius(z.cwiseAbs());
  const int s = std::min(chebyshev_stage_count(stiffness), most_stages);
  const std::vector<ChebyshevStage> stages = chebyshev_stages(s);
  Eigen::MatrixXd before = Eigen::MatrixXd::Zero(z.rows(), z.cols()), d = stages[1].rate * z;
  for (std::size_t j = 2; j < stages.size(); ++j) {
    const ChebyshevStage& c = stages[j];
    before = (c.mu * d + c.nu * before + c.rate * z * (one + d) + c.first * z).eval();
    before.swap(d);
  }
  return one + d;
}

}  // namespace

std::unique_ptr<Stepper> make_rkc2(const Rkc2Options& options) { return std::make_unique<Rkc2>(options); }

constexpr StepperKind rkc2 = {.name = "rkc2",
                              .make = []() -> std::unique_ptr<Stepper> { return make_rkc2(); },
                              .adaptive = true,
                              .holds = true,
                              .amplification = amplification,
                              .tolerance = 3e-3,
                              .jump_tolerance = 1e-2,
                              .any_step = true,
                              .matrix_free = true,
                              .gives_values = true,
                              .nodal = true};

}  // namespace pelage
