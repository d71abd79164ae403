// Seconds of the parts of a run at growing sizes, with one and two threads: reading and checking, assembly, one step,
// and the whole from shape to coloured mesh. Arguments: vertices, threads.

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "base/parallel.h"
#include "catalog/bind.h"
#include "look/dress.h"
#include "pelage/io.h"
#include "pelage/render.h"
#include "run/run.h"
#include "shape/generators.h"
#include "verify/problem.h"

namespace pelage {
namespace {

const TriangleMesh& sphere(std::int64_t vertices) {
  static std::map<std::int64_t, TriangleMesh> made;
  auto it = made.find(vertices);
  if (it == made.end())
    it = made.emplace(vertices, builtin_shape("builtin:sphere?n=" + std::to_string(vertices))).first;
  return it->second;
}

int threads(const benchmark::State& state) { return static_cast<int>(state.range(1)); }

/// A pattern of 10 vertices per wavelength, so that no refinement is needed.
Program turing_program(std::int64_t vertices) {
  Recipe recipe;
  const double edge = std::sqrt(4 * 3.14159265358979 / static_cast<double>(vertices) * 2 / std::sqrt(3.0));
  recipe.stages[0].size = Given<Length>{{10 * edge, Length::Unit::world}, {}};
  return make_program(recipe, sphere(vertices));
}

void read_and_check(benchmark::State& state, const char* extension) {
  const ThreadLimit limit(threads(state));
  const std::string path =
      (std::filesystem::temp_directory_path() / ("pelage_bench" + std::string(extension))).string();
  save(sphere(state.range(0)), path);
  for (auto _ : state) benchmark::DoNotOptimize(read_shape(path));
  std::filesystem::remove(path);
}

void assemble(benchmark::State& state, Discretisation (*discretise)(Topology)) {
  const ThreadLimit limit(threads(state));
  const TriangleMesh& mesh = sphere(state.range(0));
  const Discretisation d = discretise(make_topology(mesh.points.size(), mesh.triangles));
  for (auto _ : state) {
    const Assembler assembler(d);
    benchmark::DoNotOptimize(assembler.mass(mesh.points));
    benchmark::DoNotOptimize(assembler.stiffness(mesh.points));
  }
}

void tabulate(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  const TriangleMesh& mesh = sphere(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(make_loop(make_topology(mesh.points.size(), mesh.triangles)));
}

/// A picture of 1024 x 1024 pixels of a mesh of about 2 * vertices triangles.
void picture(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  const TriangleMesh& mesh = sphere(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(render(mesh, {}));
}

/// One step of the default stepper in the middle of the growth of a pattern.
void step(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  Program program = turing_program(state.range(0));
  program.stages[0].stationary = 0;
  Run run(std::move(program));
  run.advance(40);
  std::int64_t iterations = run.summary().iterations, steps = run.summary().steps;
  for (auto _ : state) run.advance(1);
  state.counters["cg_iterations"] =
      static_cast<double>(run.summary().iterations - iterations) / static_cast<double>(run.summary().steps - steps) / 2;
}

void whole_run(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  for (auto _ : state) {
    Run run(turing_program(state.range(0)));
    while (!run.done()) run.advance(100);
    benchmark::DoNotOptimize(dress(run.fields(), Look{}));
    state.counters["steps"] = static_cast<double>(run.summary().steps);
  }
}

/// From the end of a first stage to the beginning of a second one.
void second_stage(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  Program program = turing_program(state.range(0));
  program.stages[0].steps = 1;
  program.stages.push_back(program.stages[0]);
  program.stages[1].name = "second";
  program.stages[1].steps = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Run run(program);
    run.advance(1);
    state.ResumeTiming();
    run.advance(1);
  }
}

/// A step before which the surface moves, less a step without.
void move(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  Program program = turing_program(state.range(0));
  program.stages[0].stationary = 0;
  program.motion.growth = 1e-6;
  program.motion.every = state.range(2);
  Run run(std::move(program));
  run.advance(20);
  for (auto _ : state) run.advance(1);
}

void dress_again(benchmark::State& state) {
  const ThreadLimit limit(threads(state));
  const Run run(turing_program(state.range(0)));
  const CoatFields fields = run.fields();
  Look look;
  const Paint first = resolve_paint(look, fields.species);
  look.ramp.value = "reef";
  const Paint other = resolve_paint(look, fields.species);
  const Tessellation t = tessellate(fields, tessellation_request(look, first));
  for (auto _ : state) benchmark::DoNotOptimize(dress(t, other, fields.uniform));
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"vertices", "threads"})->ArgsProduct({{10242, 40962, 163842, 655362}, {1, 2}});
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(0.2);
}

/// One run each: minutes at the largest size.
void sizes_once(benchmark::internal::Benchmark* b) {
  b->ArgNames({"vertices", "threads"})->ArgsProduct({{10242, 40962, 163842, 655362}, {1, 2}});
  b->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
}

BENCHMARK_CAPTURE(read_and_check, ply, ".ply")->Apply(sizes);
BENCHMARK_CAPTURE(read_and_check, obj, ".obj")->Apply(sizes);
BENCHMARK(tabulate)->Apply(sizes);
BENCHMARK_CAPTURE(assemble, loop, make_loop)->Apply(sizes);
BENCHMARK_CAPTURE(assemble, linear, make_linear)->Apply(sizes);
BENCHMARK(step)->Apply(sizes);
BENCHMARK(picture)
    ->ArgNames({"vertices", "threads"})
    ->Args({100000, 1})
    ->Args({100000, 2})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(second_stage)->Apply(sizes);
BENCHMARK(move)
    ->ArgNames({"vertices", "threads", "every"})
    ->ArgsProduct({{10242, 40962, 163842}, {1, 2}, {1, 1000000}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MinTime(0.2);
BENCHMARK(dress_again)->Apply(sizes);
BENCHMARK(whole_run)->Apply(sizes_once);

}  // namespace
}  // namespace pelage
