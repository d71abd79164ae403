// Seconds from noise to rest of a zebra tile (Witkin, Kass 1991, section 6.2: e = 2, d = 1.5, s = b = k = 1), periodic,
// of 512 x 512 nodes, on one thread: their own forward Euler on masks, and the steppers of this program, alone and with
// coarser grids first. Argument: nodes per length s. Counted: steps, the model time at rest, and the wavelength of what
// has grown, which theory puts at 7.70 s. And one convolution with a Gaussian, exact by waves and by recursive filters,
// whose error, root mean square over that of the result, is counted.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "catalog/models.h"
#include "react/wavelength.h"
#include "run/nested.h"
#include "shape/grid.h"
#include "time/lattice_transform.h"

namespace pelage {
namespace {

constexpr std::size_t n = 512;
constexpr double angle = 0.5;
constexpr double longest = 100;
/// Of one convolution, in the model's time.
constexpr double spreading = 1;

/// Lengths are in s.
Program program(std::int64_t nodes, const StepperKind& kind) {
  Grid grid;
  grid.count = {n, n, 1};
  grid.periodic = {true, true, false};
  grid.spacing = {1.0 / static_cast<double>(nodes), 1.0 / static_cast<double>(nodes), 1};
  Program p;
  p.method = &grid_method;
  p.shape = std::make_shared<const TriangleMesh>(mesh_of(grid));
  p.nodes = std::make_shared<const NodeShape>(std::move(grid));
  StageProgram& stage = p.stages.emplace_back();
  const ModelSource source = load_model("witkin-kass-stripes");
  stage.model = compile(source, {{"theta", angle}});
  stage.stepper = &kind;
  stage.length_unit = 1;
  stage.size = model_wavelength(stage.model);
  stage.suggested_step = source.suggestions.step.value();
  stage.until = longest;
  stage.stationary = source.suggestions.tolerance.value();
  return p;
}

/// The waves of p - q weighted by the squares of their power, so that the strongest count.
double wavelength(const Lattice& lattice, const Vector& q, const Vector& p) {
  const LatticeTransform<double> transform(lattice);
  const Vector difference = p - q;
  std::vector<double> waves(transform.size());
  transform.forward(difference.data(), waves.data());
  const std::vector<double> k2 = transform.quadratic_form(Eigen::Matrix3d::Identity());
  double sum = 0, moment = 0;
  for (std::size_t w = 1; w < transform.waves(); ++w) {
    const double power = waves[2 * w] * waves[2 * w] + waves[2 * w + 1] * waves[2 * w + 1];
    sum += power * power;
    moment += k2[w] * power * power;
  }
  return 2 * std::numbers::pi * std::sqrt(sum / moment);
}

void count(benchmark::State& state, const Lattice& lattice, const std::vector<Vector>& u, double steps, double time) {
  state.counters["steps"] = steps;
  state.counters["time"] = time;
  state.counters["wavelength"] = wavelength(lattice, u[0], u[1]);
}

Eigen::Matrix3d tensor(double across) {
  const Eigen::Vector3d d(std::cos(angle), std::sin(angle), 0), normal(-d[1], d[0], 0);
  return 4 * d * d.transpose() + across * across * normal * normal.transpose();
}

/// Forward Euler with the masks of eq. (7) and its step, 0.02 for a spacing of 1, in plain loops.
void literal(benchmark::State& state) {
  const ThreadLimit limit(1);
  const Run start(program(state.range(0), etd));
  const double h = 1 / static_cast<double>(state.range(0)), dt = 0.02 * h * h;
  std::array<std::array<double, 9>, 2> masks;  // of q and p, rows upward
  for (std::size_t s = 0; s < 2; ++s) {
    const Eigen::Matrix3d t = tensor(s == 0 ? 1.5 : 1);
    const double corner = t(0, 1), x = 2 * t(0, 0), y = 2 * t(1, 1);
    masks[s] = {corner, y, -corner, x, -2 * (x + y) - 2 * h * h, x, -corner, y, corner};
    for (double& m : masks[s]) m *= dt / (2 * h * h);
  }
  for (auto _ : state) {
    std::vector<Vector> u = start.initial(), next = u;
    double time = 0, change = 1;
    long steps = 0;
    for (; time < longest && change >= start.stage_program().stationary; ++steps, time += dt) {
      for (std::size_t y = 0; y < n; ++y) {
        const std::size_t below = (y + n - 1) % n * n, here = y * n, above = (y + 1) % n * n;
        const auto node = [&](std::size_t x, std::size_t left, std::size_t right) {
          const double made = u[1].data()[here + x] > u[0].data()[here + x] ? dt : 0;
          for (std::size_t s = 0; s < 2; ++s) {
            const double* c = u[s].data();
            const auto& m = masks[s];
            next[s].data()[here + x] = c[here + x] + made + m[0] * c[below + left] + m[1] * c[below + x] +
                                       m[2] * c[below + right] + m[3] * c[here + left] + m[4] * c[here + x] +
                                       m[5] * c[here + right] + m[6] * c[above + left] + m[7] * c[above + x] +
                                       m[8] * c[above + right];
          }
        };
        node(0, n - 1, 1);
        for (std::size_t x = 1; x + 1 < n; ++x) node(x, x - 1, x + 1);
        node(n - 1, n - 2, 0);
      }
      if (steps % 50 == 49) {
        change = 0;
        for (std::size_t s = 0; s < 2; ++s) {
          const double deviation = (next[s].array() - next[s].mean()).matrix().norm();
          change = std::max(change, (next[s] - u[s]).norm() / (dt * deviation));
        }
      }
      std::swap(u, next);
    }
    state.PauseTiming();
    count(state, *start.system().lattice, u, static_cast<double>(steps), time);
    state.ResumeTiming();
  }
}

void grow(benchmark::State& state, const StepperKind& kind, bool nested) {
  const ThreadLimit limit(1);
  for (auto _ : state) {
    state.PauseTiming();
    Run run(program(state.range(0), kind));
    state.ResumeTiming();
    if (nested) grow_nested(run);
    while (!run.done()) run.advance(10);
    state.PauseTiming();
    if (run.summary().status == RunStatus::failed) state.SkipWithError(run.summary().message.c_str());
    count(state, *run.system().lattice, run.coefficients(), static_cast<double>(run.summary().steps),
          run.summary().time);
    state.ResumeTiming();
  }
}

/// One convolution with the Gaussian of q in a time, by waves and by recursive filters.
void exact(benchmark::State& state) {
  const ThreadLimit limit(1);
  const Run start(program(state.range(0), etd));
  const LatticeTransform<double> transform(*start.system().lattice);
  Vector u = start.initial()[0];
  std::vector<double> waves(transform.size()), factor = transform.quadratic_form(tensor(1.5));
  for (double& f : factor) f = std::exp(-spreading * f);
  for (auto _ : state) {
    transform.forward(u.data(), waves.data());
    for (std::size_t w = 0; w < factor.size(); ++w)
      for (std::size_t part = 0; part < 2; ++part) waves[2 * w + part] *= factor[w];
    transform.inverse(waves.data(), u.data());
  }
}

/// Third-order recursive filter of Young, van Vliet 1995.
struct Recursive {
  double b, b1, b2, b3;
  explicit Recursive(double sigma) {
    const double q = sigma < 2.5 ? 3.97156 - 4.14554 * std::sqrt(1 - 0.26891 * sigma) : 0.98711 * sigma - 0.9633;
    const double b0 = 1.57825 + q * (2.44413 + q * (1.4281 + q * 0.422205));
    b1 = q * (2.44413 + q * (2.85619 + q * 1.26661)) / b0;
    b2 = -q * q * (1.4281 + q * 1.26661) / b0;
    b3 = q * q * q * 0.422205 / b0;
    b = 1 - b1 - b2 - b3;
  }
  double next(double x, double y1, double y2, double y3) const { return b * x + b1 * y1 + b2 * y2 + b3 * y3; }
};

/// Along a row and back, begun early enough to forget where.
void filter_row(const Recursive& f, std::size_t early, double* row) {
  for (const bool back : {false, true}) {
    std::array<double, n> out;
    double y1 = 0, y2 = 0, y3 = 0;
    for (std::size_t i = 0; i < n + early; ++i) {
      const std::size_t x = back ? (2 * n + early - 1 - i) % n : (i + n - early) % n;
      const double y = f.next(row[x], y1, y2, y3);
      y3 = y2, y2 = y1, y1 = y;
      out[x] = y;
    }
    std::ranges::copy(out, row);
  }
}

/// The row at a shift along it, linear between nodes.
void shift_row(const double* row, double shift, double* out) {
  const double whole = std::floor(shift), part = shift - whole;
  const auto first = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(n) * 4 + static_cast<std::ptrdiff_t>(whole));
  for (std::size_t x = 0; x < n; ++x) out[x] = (1 - part) * row[(x + first) % n] + part * row[(x + first + 1) % n];
}

/// Along x, and then along the sheared axis (slope, 1) from row to row (Geusebroek, Smeulders, van de Weijer 2003).
void filter_field(const Eigen::Matrix3d& covariance, Vector& u) {
  const double down = std::sqrt(covariance(1, 1)), slope = covariance(0, 1) / covariance(1, 1);
  const double along = std::sqrt(covariance(0, 0) - covariance(0, 1) * slope);
  const Recursive row_filter(along), filter(down);
  const auto early = static_cast<std::size_t>(12 * std::max(along, down)) + 3;
  for (std::size_t y = 0; y < n; ++y) filter_row(row_filter, early, u.data() + n * y);
  for (const double direction : {1.0, -1.0}) {
    Vector out(u.size());
    std::array<std::array<double, n>, 4> before{}, shifted;
    for (std::size_t i = 0; i < n + early; ++i) {
      const std::size_t y = direction > 0 ? (i + n - early % n) % n : (2 * n + early - 1 - i) % n;
      for (std::size_t k = 1; k <= 3; ++k)
        shift_row(before[(i - k) % 4].data(), -direction * slope * static_cast<double>(k), shifted[k].data());
      for (std::size_t x = 0; x < n; ++x)
        before[i % 4][x] = filter.next(u.data()[x + n * y], shifted[1][x], shifted[2][x], shifted[3][x]);
      std::ranges::copy(before[i % 4], out.data() + n * y);
    }
    u = out;
  }
}

void recursive(benchmark::State& state) {
  const ThreadLimit limit(1);
  const Run start(program(state.range(0), etd));
  const auto nodes = static_cast<double>(state.range(0));
  const Eigen::Matrix3d covariance = 2 * spreading * nodes * nodes * tensor(1.5);
  const Vector before = start.initial()[0];
  Vector u;
  for (auto _ : state) {
    u = before;
    filter_field(covariance, u);
  }
  const LatticeTransform<double> transform(*start.system().lattice);
  std::vector<double> waves(transform.size());
  const std::vector<double> form = transform.quadratic_form(tensor(1.5));
  Vector expected(u.size());
  transform.forward(before.data(), waves.data());
  for (std::size_t w = 0; w < form.size(); ++w)
    for (std::size_t part = 0; part < 2; ++part) waves[2 * w + part] *= std::exp(-spreading * form[w]);
  transform.inverse(waves.data(), expected.data());
  state.counters["error"] = (u - expected).norm() / expected.norm();
}

void settings(benchmark::internal::Benchmark* b) {
  b->ArgName("nodes")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Iterations(1);
}

BENCHMARK(literal)->Apply(settings);
BENCHMARK_CAPTURE(grow, sbdf2, sbdf2, false)->Apply(settings);
BENCHMARK_CAPTURE(grow, rkc2, rkc2, false)->Apply(settings);
BENCHMARK_CAPTURE(grow, etd, etd, false)->Apply(settings);
BENCHMARK_CAPTURE(grow, gaussian, gaussian_stepper, false)->Apply(settings);
BENCHMARK_CAPTURE(grow, sign iteration, sign_iteration, false)->Apply(settings);
BENCHMARK_CAPTURE(grow, binary, binary_stepper, false)->Apply(settings);
BENCHMARK_CAPTURE(grow, rkc2 nested, rkc2, true)->Apply(settings);
BENCHMARK_CAPTURE(grow, etd nested, etd, true)->Apply(settings);
BENCHMARK_CAPTURE(grow, gaussian nested, gaussian_stepper, true)->Apply(settings);
BENCHMARK_CAPTURE(grow, binary nested, binary_stepper, true)->Apply(settings);
BENCHMARK(exact)->ArgName("nodes")->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(recursive)->ArgName("nodes")->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace pelage
