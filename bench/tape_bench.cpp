// Rates of a million samples: the tape of a model file against the same kinetics written by hand in C++.
// Both run on one thread, read and write the same arrays, and give the same values.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "catalog/models.h"
#include "react/kinetics.h"

namespace pelage {
namespace {

constexpr std::size_t samples = 1000000;

struct Fields {
  std::vector<Point> positions;
  std::vector<double> u, v, du, dv, beta;
};

const Fields& inputs() {
  static const Fields fields = [] {
    Fields f;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> number(0, 1);
    f.positions.resize(samples);
    for (Point& p : f.positions) p = {number(random), number(random), number(random)};
    f.u.resize(samples);
    f.v.resize(samples);
    f.beta.resize(samples);
    for (double& value : f.u) value = number(random);
    for (double& value : f.v) value = number(random);
    for (double& value : f.beta) value = 12 + 0.1 * number(random);
    return f;
  }();
  return fields;
}

void tape(benchmark::State& state, const std::string& name) {
  Fields f = inputs();
  f.du.resize(samples);
  f.dv.resize(samples);
  const Kinetics kinetics(compile(load_model(name)), {.positions = f.positions}, 1);
  const double* u[] = {f.u.data(), f.v.data()};
  double* out[] = {f.du.data(), f.dv.data()};
  for (auto _ : state) {
    for (std::size_t begin = 0; begin < samples; begin += 2048)  // as the time steppers call it
      kinetics.rates(u, 0, begin, std::min(begin + 2048, samples), out);
    benchmark::ClobberMemory();
  }
}

void turing_by_hand(benchmark::State& state) {
  Fields f = inputs();
  f.du.resize(samples);
  f.dv.resize(samples);
  const double* __restrict u = f.u.data(), * __restrict v = f.v.data(), * __restrict beta = f.beta.data();
  double* __restrict du = f.du.data(), * __restrict dv = f.dv.data();
  double s = 0.05;
  benchmark::DoNotOptimize(s);
  for (auto _ : state) {
    for (std::size_t i = 0; i < samples; ++i) {
      const double a = u[i], b = std::max(v[i], 0.0);
      du[i] = s * (16 - a * b);
      dv[i] = s * (a * b - b - beta[i]);
    }
    benchmark::ClobberMemory();
  }
}

void gray_scott_by_hand(benchmark::State& state) {
  Fields f = inputs();
  f.du.resize(samples);
  f.dv.resize(samples);
  const double* __restrict u = f.u.data(), * __restrict v = f.v.data();
  double* __restrict du = f.du.data(), * __restrict dv = f.dv.data();
  double feed = 0.05, kill = 0.063;
  benchmark::DoNotOptimize(feed);
  benchmark::DoNotOptimize(kill);
  for (auto _ : state) {
    for (std::size_t i = 0; i < samples; ++i) {
      const double a = std::max(u[i], 0.0), b = std::max(v[i], 0.0);
      du[i] = -a * b * b + feed * (1 - a);
      dv[i] = a * b * b - (feed + kill) * b;
    }
    benchmark::ClobberMemory();
  }
}

BENCHMARK_CAPTURE(tape, turing, "turing")->Unit(benchmark::kMillisecond);
BENCHMARK(turing_by_hand)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tape, gray_scott, "gray-scott")->Unit(benchmark::kMillisecond);
BENCHMARK(gray_scott_by_hand)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pelage
