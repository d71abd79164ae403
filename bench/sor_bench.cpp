// One implicit step on a fitted grid of n x n nodes, (M + dt K) u = b from a zero guess to 1e-10 on one thread:
// conjugate gradients with the diagonal, as the steppers take them, and successive over-relaxation, coloured and as
// nodes are numbered. Arguments: n, and the longest way of diffusion in a step in mean edges. Counted: iterations or
// sweeps, and the best of some relaxation factors.

#include <benchmark/benchmark.h>

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "discretise/method.h"
#include "linalg/sor.h"

namespace pelage {
namespace {

struct Problem {
  SparseMatrix matrix;
  Vector right;
};

Problem problem(std::int32_t n, double edges) {
  Grid g;
  g.count = {n, n, 1};
  for (std::int32_t v = 0; v < n * n; ++v) {
    const double x = static_cast<double>(v % n) / (n - 1), y = static_cast<double>(v / n) / (n - 1);
    g.points.push_back({x + 0.3 * x * (1 - x) * y, y + 0.2 * std::sin(3 * x) * y * (1 - y), 0});
  }
  const auto space = grid_method.make_node_space(g);
  Problem p;
  combine(1, *space->sampled(SampleRule::vertices).mass, std::pow(edges / n, 2), *space->stiffness(), p.matrix);
  p.right.resize(n * n);
  for (Index i = 0; i < n * n; ++i) p.right[i] = uniform(5, static_cast<std::uint64_t>(i)) - 0.5;
  return p;
}

void gradients(benchmark::State& state) {
  const ThreadLimit limit(1);
  const Problem p = problem(static_cast<std::int32_t>(state.range(0)), static_cast<double>(state.range(1)));
  const Jacobi<Vector> preconditioner(diagonal(p.matrix));
  ConjugateGradientWork<Vector> work;
  SolveReport report;
  for (auto _ : state) {
    Vector x = Vector::Zero(p.right.size());
    report = conjugate_gradient(p.matrix, preconditioner, p.right, x, nullptr, {.tolerance = 1e-10}, work);
  }
  state.counters["iterations"] = report.iterations;
}

SolveReport relaxed(const Problem& p, const SweepColours& order, double relaxation) {
  Vector x = Vector::Zero(p.right.size());
  return successive_over_relaxation(p.matrix, order, p.right, x, nullptr, {.relaxation = relaxation});
}

void relaxation(benchmark::State& state, bool coloured) {
  const ThreadLimit limit(1);
  const Problem p = problem(static_cast<std::int32_t>(state.range(0)), static_cast<double>(state.range(1)));
  const SparsePattern& pattern = *p.matrix.pattern;
  const SweepColours order = coloured ? SweepColours(pattern) : SweepColours::lexicographic(pattern);
  double best = 1;
  int fewest = 1 << 30;
  for (double w = 1.1; w < 2; w += 0.1)
    if (const SolveReport r = relaxed(p, order, w); r.converged && r.iterations < fewest) {
      best = w;
      fewest = r.iterations;
    }
  for (auto _ : state) relaxed(p, order, best);
  state.counters["sweeps"] = fewest;
  state.counters["factor"] = best;
}

void settings(benchmark::internal::Benchmark* b) {
  b->Args({256, 2})->Args({64, 8})->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

BENCHMARK(gradients)->Apply(settings);
BENCHMARK_CAPTURE(relaxation, coloured, true)->Apply(settings);
BENCHMARK_CAPTURE(relaxation, lexicographic, false)->Apply(settings);

}  // namespace
}  // namespace pelage
