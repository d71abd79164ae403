// Seconds of the parts of a coat on cells: scattering and relaxing points, the space on them, and spots to rest.
// Arguments: cells, threads.

#include <benchmark/benchmark.h>

#include <cmath>

#include "base/parallel.h"
#include "catalog/bind.h"
#include "discretise/cell_space.h"
#include "run/run.h"
#include "shape/cells.h"
#include "shape/generators.h"

namespace pelage {
namespace {

std::size_t cells(const benchmark::State& state) { return static_cast<std::size_t>(state.range(0)); }
int threads(const benchmark::State& state) { return static_cast<int>(state.range(1)); }

std::shared_ptr<const TriangleMesh> animal() {
  static const auto mesh = std::make_shared<const TriangleMesh>(builtin_shape("builtin:animal"));
  return mesh;
}

void scatter(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  for (auto _ : state) benchmark::DoNotOptimize(make_cells(animal(), cells(state)));
}

void space(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  const Cells made = make_cells(animal(), cells(state));
  for (auto _ : state) benchmark::DoNotOptimize(CellSpace(made));
}

/// The whole: ten cells per wavelength, from the mesh to rest.
void spots(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  Recipe recipe;
  const double edge = std::sqrt(2 / std::sqrt(3.0) * 5.362 / static_cast<double>(cells(state)));  // 5.362: its area
  recipe.stages[0].size = Given<Length>{{10 * edge, Length::Unit::world}, {}};
  recipe.stages[0].cells = Given<std::int64_t>{state.range(0), {}};
  for (auto _ : state) {
    Run run(make_program(recipe, *animal()));
    while (!run.done()) run.advance(100);
    benchmark::DoNotOptimize(run.summary());
  }
}

BENCHMARK(scatter)->Args({64000, 1})->Args({64000, 2})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(space)->Args({64000, 1})->Args({64000, 2})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(spots)->Args({64000, 1})->Args({64000, 2})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace pelage
