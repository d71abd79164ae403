// Seconds of the parts of a coat inside a ball of about 300,000 tetrahedra: filling, the space, and two species to
// rest. Argument: threads. Counted: tetrahedra.

#include <benchmark/benchmark.h>

#include "base/parallel.h"
#include "catalog/bind.h"
#include "discretise/tet_space.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/tet_mesh.h"
#include "solid/fill.h"

namespace pelage {
namespace {

constexpr double edge = 0.055;
constexpr std::size_t most = 1'000'000;

const TriangleMesh& ball() {
  static const TriangleMesh mesh = builtin_shape("builtin:sphere?n=10242");
  return mesh;
}

void filling(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  for (auto _ : state) state.counters["tets"] = static_cast<double>(fill(ball(), edge, most).volume.tets.size());
}

void space(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const TetMesh volume = fill(ball(), edge, most).volume;
  for (auto _ : state) benchmark::DoNotOptimize(TetSpace(volume));
}

/// Filled beforehand; ten edges to the wavelength.
void spots(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  TetMesh volume = fill(ball(), edge, most).volume;
  const TriangleMesh mesh = mesh_of(volume);
  const auto nodes = std::make_shared<const NodeShape>(std::move(volume));
  Recipe recipe;
  recipe.stages[0].size = Given<Length>{{10 * edge, Length::Unit::world}, {}};
  for (auto _ : state) {
    Run run(bind_plan(plan(recipe), nodes, mesh));
    while (!run.done()) run.advance(100);
    benchmark::DoNotOptimize(run.summary());
  }
}

BENCHMARK(filling)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(space)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(spots)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace pelage
