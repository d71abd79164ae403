// Seconds of a coat of 30,000 vertices as images of 4096 x 4096 texels on the uv of a torus, and of writing the colours
// as PNG. Argument: threads.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "catalog/bind.h"
#include "look/bake.h"
#include "pelage/io.h"
#include "run/run.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// With its two angles as uv.
TriangleMesh torus() {
  TriangleMesh mesh = builtin_shape("builtin:torus?n=3000");
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 2> first{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = mesh.points[static_cast<std::size_t>(t[k])];
      std::array<double, 2> turns = {std::atan2(p[1], p[0]), std::atan2(p[2], std::hypot(p[0], p[1]) - 1)};
      for (std::size_t c = 0; c < 2; ++c) {
        turns[c] = turns[c] / (2 * std::numbers::pi) + 0.5;
        if (k == 0) first[c] = turns[c];
        uv.values.push_back(0.1 + 0.7 * (turns[c] - std::round(turns[c] - first[c])));
      }
    }
  }
  mesh.set(std::move(uv));
  return mesh;
}

const CoatFields& coat() {
  static const CoatFields fields = [] {
    Recipe recipe;
    recipe.stages[0].size = Given<Length>{{0.044, Length::Unit::diagonals}, {}};
    ShapeFile shape = check_shape(torus());
    Run run(bind_plan(plan(recipe), shape));
    while (!run.done()) run.advance(100);
    return run.fields();
  }();
  return fields;
}

void bake_colors(benchmark::State& state) {
  const CoatFields& fields = coat();
  const Paint paint = resolve_paint(Look{}, fields.species);
  const Tessellation t = tessellate(fields, tessellation_request(Look{}, paint));
  const UvLayout layout(fields.shape->triangles, *fields.shape->find("uv"), 4096);
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const CoatSampler sampler(fields, t, paint);
    const BakedCoat baked = bake(sampler, make_palette(paint, t.samples, fields.uniform), layout, nullptr);
    benchmark::DoNotOptimize(png_bytes(baked.tiles[0].color));
  }
  state.counters["vertices"] = static_cast<double>(fields.space->unknowns());
}

BENCHMARK(bake_colors)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace pelage
