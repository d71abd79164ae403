// Seconds to take the noise off a mesh. Arguments: vertices, threads.

#include <benchmark/benchmark.h>

#include "base/parallel.h"
#include "base/random.h"
#include "pelage/fair.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// The built-in animal with noise of a fifth of an edge in all directions.
TriangleMesh noisy_animal(std::int64_t vertices) {
  TriangleMesh mesh = builtin_shape("builtin:animal?n=" + std::to_string(vertices));
  const double edge = fair(mesh, {.steps = 0}).report.mean_edge;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) mesh.points[v][k] += 0.7 * edge * (uniform(k, v) - 0.5);
  return mesh;
}

void guided(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(1)));
  const TriangleMesh mesh = noisy_animal(state.range(0));
  for (auto _ : state) state.counters["steps"] = fair(mesh).report.steps;
}

BENCHMARK(guided)
    ->ArgNames({"vertices", "threads"})
    ->ArgsProduct({{6500, 100000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
}  // namespace pelage
