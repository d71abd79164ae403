#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "time/binary_convolution.h"
#include "time/lattice_step.h"

namespace pelage {

namespace {

/// The weights of a kernel add up to this, so that two sums fit into 32 bits.
constexpr int whole = 1 << 15;
/// Kernels reach so many standard deviations.
constexpr double deviations = 4;
/// Rounds of a step at most, so that what a step costs beside them hardly counts.
constexpr int most_rounds = 25;
/// Rates that differ by less than this share of the production count as equal.
constexpr double rounding = 1e-9;

/// Two species that decay alike and are made alike where the first is more than the second:
///   du_i/dt = div T_i grad u_i - b u_i + k (u_0 > u_1)
struct ThresholdPair {
  std::array<std::size_t, 2> species{};
  double b = 0, k = 0;
  std::vector<std::uint8_t> on;
};

/// Why these species, in this order, are not such a pair; empty if they are.
std::string find_pair(const System& system, const State& state, const LinearParts& parts, ThresholdPair& pair) {
  for (const std::size_t i : pair.species)
    if (!(system.species[i].tensor->trace() > 0)) return system.species[i].name + " has to spread";
  pair.b = -parts.c(pair.species[0]);
  if (!(pair.b > 0) || std::abs(parts.c(pair.species[1]) + pair.b) > rounding * pair.b)
    return "its species have to decay, both at the same constant rate";
  const Vector &plus = state.now[pair.species[0]], &minus = state.now[pair.species[1]];
  pair.on.resize(static_cast<std::size_t>(plus.size()));
  parallel_for(pair.on.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) pair.on[n] = plus.data()[n] > minus.data()[n];
  });
  pair.k = std::max(0.0, maximum(parts.rest(pair.species[0])));
  for (const std::size_t i : pair.species) {
    const Vector& rest = parts.rest(i);
    const double tolerance = rounding * std::max(pair.k, -minimum(rest));
    const auto others = ordered_sum(pair.on.size(), 0, [&](std::size_t begin, std::size_t end) {
      int count = 0;
      for (std::size_t n = begin; n < end; ++n)
        count += !(std::abs(rest.data()[n] - (pair.on[n] ? pair.k : 0)) <= tolerance);
      return count;
    });
    if (others > 0)
      return "its species have to be made, both at one rate, where " + system.species[pair.species[0]].name +
             " is more than " + system.species[pair.species[1]].name + ", and not elsewhere";
  }
  return {};
}

int dimension_of(const Lattice& lattice) { return lattice.count[1] > 1 ? 2 : 1; }

/// The time in which both have to spread so that the waves that differ most are those of the steady state,
///   1/(b + x) - 1/(b + r x) at x = b / sqrt(r)   and   exp(-x t) - exp(-r x t) at x t = ln r / (r - 1),
/// where r is the largest ratio of the two diffusions, of any direction.
double spreading_time(const Eigen::Matrix3d& a, const Eigen::Matrix3d& other, double b, int dimension) {
  const Eigen::MatrixXd first = a.topLeftCorner(dimension, dimension),
                        second = other.topLeftCorner(dimension, dimension);
  const Eigen::VectorXd ratios = eigenvalues(solved(second, first)).real();
  const double r = std::max(ratios.maxCoeff(), 1 / ratios.minCoeff());
  const double spread = r - 1 > 1e-6 ? std::log(r) / (r - 1) : 1;
  return std::sqrt(r) * spread / b;
}

/// Values of the Gaussian of a tensor and a time, row by row.
std::vector<double> gaussian_values(const Lattice& lattice, const std::array<std::size_t, 2>& reach,
                                    const Eigen::Matrix3d& tensor, double time) {
  const int dimension = dimension_of(lattice);
  const Eigen::MatrixXd inverse =
      solved(tensor.topLeftCorner(dimension, dimension), Eigen::MatrixXd::Identity(dimension, dimension));
  const auto rx = static_cast<std::ptrdiff_t>(reach[0]), ry = static_cast<std::ptrdiff_t>(reach[1]);
  std::vector<double> values;
  for (std::ptrdiff_t dy = -ry; dy <= ry; ++dy)
    for (std::ptrdiff_t dx = -rx; dx <= rx; ++dx) {
      const Eigen::Vector2d p(static_cast<double>(dx) * lattice.spacing[0],
                              static_cast<double>(dy) * lattice.spacing[1]);
      values.push_back(std::exp(-p.head(dimension).dot(inverse * p.head(dimension)) / (4 * time)));
    }
  return values;
}

/// Integers in these proportions that add up to `whole`: the factor for which they nearly do, and the rest in the
/// middle.
std::vector<std::uint32_t> whole_numbers(const std::vector<double>& values) {
  std::vector<std::uint32_t> weights(values.size());
  const auto round_by = [&](double factor) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
      sum += weights[k] = static_cast<std::uint32_t>(std::lround(factor * values[k]));
    return sum;
  };
  double low = 0, high = 2 * whole;
  for (int halvings = 0; halvings < 50; ++halvings)
    (round_by((low + high) / 2) <= whole ? low : high) = (low + high) / 2;
  weights[weights.size() / 2] += static_cast<std::uint32_t>(whole - round_by(low));
  return weights;
}

std::string why_not(const System& system, const std::vector<std::size_t>& evolving) {
  if (std::string why = why_no_waves(system); !why.empty()) return why;
  if (system.lattice->count[2] > 1) return "it does not grow in three dimensions";
  if (evolving.size() != 2) return "it grows pairs of species, and these are " + std::to_string(evolving.size());
  return {};
}

/// Binary convolution (Witkin, Kass 1991, section 5; Young 1984): where species decay so fast that only what is being
/// made counts, the state is where the first is more than the second, and a round
///   u_i = k / b (G_i * on),   on = u_0 > u_1
/// convolves these bits with a Gaussian for each, exactly, in whole numbers. A step is some rounds of this iteration,
/// however long; it comes to rest where no bit changes. The Gaussians are those whose pattern has the wavelength of the
/// equations. The fields of the start are convolved once as they are.
class Binary final : public Stepper {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request) override;

 private:
  void bind(const System& system, const ThresholdPair& pair);
  int spread_start(const System& system, const ThresholdPair& pair);
  int spread_bits(ThresholdPair& pair);

  LinearParts parts_;
  double time_ = 0;
  std::optional<BinaryConvolution> convolution_;
  std::vector<Vector> next_;
};

void Binary::bind(const System& system, const ThresholdPair& pair) {
  const Lattice& lattice = *system.lattice;
  const Eigen::Matrix3d &first = *system.species[pair.species[0]].tensor,
                        &second = *system.species[pair.species[1]].tensor;
  time_ = spreading_time(first, second, pair.b, dimension_of(lattice));
  PairedKernel kernel;
  for (int a = 0; a < dimension_of(lattice); ++a)
    kernel.reach[a] = static_cast<std::size_t>(
        std::ceil(deviations * std::sqrt(2 * time_ * std::max(first(a, a), second(a, a))) / lattice.spacing[a]));
  kernel.weight = whole_numbers(gaussian_values(lattice, kernel.reach, first, time_));
  const std::vector<std::uint32_t> other = whole_numbers(gaussian_values(lattice, kernel.reach, second, time_));
  for (std::size_t k = 0; k < other.size(); ++k) kernel.weight[k] += other[k] << 16;
  convolution_.emplace(lattice, std::move(kernel));
}

/// Nothing has been made yet: the fields, and what is made in the time, spread.
int Binary::spread_start(const System& system, const ThresholdPair& pair) {
  const LatticeTransform<double> transform(*system.lattice);
  std::vector<double> waves(transform.size());
  for (std::size_t s = 0; s < 2; ++s) {
    const std::size_t i = pair.species[s];
    const std::vector<double> form = transform.quadratic_form(*system.species[i].tensor);
    axpby(std::expm1(pair.b * time_) / pair.b, parts_.rest(i), 1, next_[i]);
    transform.forward(next_[i].data(), waves.data());
    for_waves(transform, [&](std::size_t w, std::size_t n) { waves[n] *= std::exp(-time_ * (pair.b + form[w])); });
    transform.inverse(waves.data(), next_[i].data());
  }
  return 1;
}

bool first_is_more(std::uint32_t sums) { return (sums & 0xffff) > sums >> 16; }

/// Returns the number of rounds.
int Binary::spread_bits(ThresholdPair& pair) {
  const std::vector<std::uint32_t>& sums = convolution_->sums();
  int rounds = 0;
  while (rounds < most_rounds && (convolution_->update(pair.on) > 0 || rounds == 0)) {
    ++rounds;
    if (rounds < most_rounds)
      parallel_for(sums.size(), [&](std::size_t begin, std::size_t end) {
        std::transform(sums.data() + begin, sums.data() + end, pair.on.data() + begin, first_is_more);
      });
  }
  for (std::size_t s = 0; s < 2; ++s) {
    const double gain = pair.k / pair.b / whole;
    Vector& u = next_[pair.species[s]];
    parallel_for(sums.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) u[static_cast<Eigen::Index>(n)] = gain * (sums[n] >> (16 * s) & 0xffff);
    });
  }
  return rounds;
}

StepReport Binary::step(const System& system, State& state, const StepRequest& request) {
  const std::vector<std::size_t> evolving = evolving_species(system);
  if (std::string why = why_not(system, evolving); !why.empty()) return refusal(std::move(why));
  StepReport report;
  parts_.split(system, state.now, state.time);
  // What spreads less is made where there is more of it.
  const bool in_order = system.species[evolving[0]].tensor->trace() < system.species[evolving[1]].tensor->trace();
  ThresholdPair pair{.species = {evolving[in_order ? 0 : 1], evolving[in_order ? 1 : 0]}, .on = {}};
  if (std::string why = find_pair(system, state, parts_, pair); !why.empty()) return refusal(std::move(why));
  if (!convolution_) bind(system, pair);
  next_ = state.now;
  if (state.step == 0) report.iterations = spread_start(system, pair);
  parts_.clear();
  if (state.step > 0) report.iterations = spread_bits(pair);
  advance(system, state, request.dt, next_, report);
  return report;
}

}  // namespace

constexpr StepperKind binary_stepper = {.name = "binary",
                                        .make = []() -> std::unique_ptr<Stepper> { return std::make_unique<Binary>(); },
                                        .lattice = true,
                                        .matrix_free = true,
                                        .nodal = true};

}  // namespace pelage
