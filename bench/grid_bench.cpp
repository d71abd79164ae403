// A grid of 200 x 200 nodes for every built-in region.

#include <benchmark/benchmark.h>

#include "catalog/regions.h"

namespace pelage {
namespace {

void make_grid(benchmark::State& state, const std::string& name) {
  const Region region = load_region(name);
  for (auto _ : state) {
    const GeneratedGrid grid = generate(region, {.nodes = std::array{200, 200}});
    state.counters["iterations"] = grid.iterations;
    state.counters["smallest_angle"] = grid.quality.smallest_angle;
    state.counters["smallest_area"] = grid.quality.smallest_area;
    state.counters["folded"] = static_cast<double>(grid.quality.folded);
  }
}

[[maybe_unused]] const bool registered = [] {
  for (const std::string& name : region_names())
    benchmark::RegisterBenchmark(("grid/" + name).c_str(), make_grid, name)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime();
  return true;
}();

}  // namespace
}  // namespace pelage
