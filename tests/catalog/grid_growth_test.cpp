// Coats on grids: tiles that wrap exactly, and the same coat with and without matrices.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "catalog/bind.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "run/run.h"
#include "shape/builtin_grids.h"

namespace pelage {
namespace {

using GridRun = Run;  // in a test, Run is a function of its own

Grid with_start(Grid grid, std::int32_t shift_x, std::int32_t shift_y) {
  Attribute start{"start", 1, Domain::vertex, {}, NumberType::float64};
  for (std::int32_t j = 0; j < grid.count[1]; ++j)
    for (std::int32_t i = 0; i < grid.count[0]; ++i) {
      const std::int32_t from = grid.node((i + shift_x) % grid.count[0], (j + shift_y) % grid.count[1], 0);
      start.values.push_back(2 * uniform(7, static_cast<std::uint64_t>(from)) - 1);
    }
  grid.set(std::move(start));
  return grid;
}

GridRun run_on(const Grid& grid, const std::string& stage) {
  return GridRun(make_program(parse_recipe("[stage]\n" + stage, "test"), grid));
}

void grow(GridRun& run, std::int64_t steps) {
  run.advance(steps);
  ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
}

/// A tile has no first node: a start that is moved by half of it gives the moved coat, to the last bit.
TEST(GridGrowth, ATileWrapsExactly) {
  const std::int32_t n = 256;
  const Grid tile = builtin_grid("builtin:tile?n=256");
  const std::string stage =
      "model = \"schnakenberg\"\nsize = \"14px\"\n"
      "initial = { u = \"1 + 0.1*attribute(start)\" }\n";
  GridRun run = run_on(with_start(tile, 0, 0), stage), moved = run_on(with_start(tile, n / 2, n / 2), stage);
  for (GridRun* r : {&run, &moved}) grow(*r, 60);
  EXPECT_EQ(run.summary().time, moved.summary().time);
  for (std::size_t s = 0; s < run.coefficients().size(); ++s) {
    std::int64_t other = 0;
    for (std::int32_t j = 0; j < n; ++j)
      for (std::int32_t i = 0; i < n; ++i)
        other += moved.coefficients()[s][tile.node(i, j, 0)] !=
                 run.coefficients()[s][tile.node((i + n / 2) % n, (j + n / 2) % n, 0)];
    EXPECT_EQ(other, 0) << s;
  }
  EXPECT_FALSE(run.uniform());
}

double largest_difference(const Vector& a, const Vector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// A map of the size that is 1 everywhere asks for matrices. Along a line they hold the same numbers; in the plane and
/// in space products of differences across each other are left out without them, which counts less the finer the grid.
TEST(GridGrowth, IsNearlyTheSameWithAndWithoutMatrices) {
  const auto difference = [](const std::string& name, const char* size) {
    const Grid grid = builtin_grid(name);
    const std::string stage =
        "model = \"turing\"\nsize = \"" + std::string(size) + "\"\nstepper = \"rkc2\"\nstep = 5\n";
    GridRun plain = run_on(grid, stage), with = run_on(grid, stage + "size-map = \"1 + 1e-9*x\"\n");
    EXPECT_EQ(plain.system().mass, nullptr);
    EXPECT_NE(with.system().mass, nullptr);
    for (GridRun* r : {&plain, &with}) grow(*r, 20);
    double largest = 0;
    for (std::size_t s = 0; s < 2; ++s)
      largest = std::max(largest, largest_difference(plain.coefficients()[s], with.coefficients()[s]));
    return largest;
  };
  EXPECT_LT(difference("builtin:line?n=80", "9px"), 2e-4);
  EXPECT_LT(difference("builtin:tile?n=72", "18px"), 3e-3);
  EXPECT_LT(difference("builtin:sheet?n=49x41", "18px"), 3e-3);
  EXPECT_LT(difference("builtin:box?n=27", "18px"), 3e-2);
}

/// What a closed sheet shows, a periodic one of twice the size shows with its mirror image.
TEST(GridGrowth, ClosedBordersAreMirrors) {
  Grid closed = builtin_grid("builtin:sheet?n=33x25");
  Grid doubled = builtin_grid("builtin:sheet?n=64x48&periodic=xy");
  doubled.spacing = closed.spacing;
  const auto mirrored = [](std::int32_t i, std::int32_t n) { return i < n ? i : 2 * (n - 1) - i; };
  closed = with_start(closed, 0, 0);
  Attribute start = *closed.find("start");
  std::vector<double> values;
  for (std::int32_t j = 0; j < 48; ++j)
    for (std::int32_t i = 0; i < 64; ++i)
      values.push_back(start.values[static_cast<std::size_t>(closed.node(mirrored(i, 33), mirrored(j, 25), 0))]);
  start.values = std::move(values);
  doubled.set(std::move(start));
  const std::string stage =
      "model = \"schnakenberg\"\nsize = \"9px\"\nstepper = \"sbdf2\"\nstep = 0.1\n"
      "initial = { u = \"1 + 0.1*attribute(start)\" }\nsize-map = \"1 + 1e-9*x\"\n";
  GridRun one = run_on(closed, stage), two = run_on(doubled, stage);
  for (GridRun* r : {&one, &two}) grow(*r, 30);
  double largest = 0;
  for (std::int32_t j = 0; j < 25; ++j)
    for (std::int32_t i = 0; i < 33; ++i)
      largest = std::max(largest, std::abs(one.coefficients()[1][closed.node(i, j, 0)] -
                                           two.coefficients()[1][doubled.node(i, j, 0)]));
  EXPECT_LT(largest, 1e-6);
}

TEST(GridGrowth, TheWavelengthIsTheOneAskedFor) {
  GridRun run = run_on(builtin_grid("builtin:tile?n=192"), "model = \"turing\"\nsize = \"16px\"\n");
  run.advance(1'000'000);
  EXPECT_NE(run.summary().status, RunStatus::failed);
  const double wavelength = measured_wavelength(*run.space().sampled(SampleRule::vertices).mass,
                                                *run.space().stiffness(), run.coefficients()[1]);
  EXPECT_NEAR(wavelength * 192 / 16, 1, 0.15);
}

/// Checkpoints, masks, pins, maps, earlier stages: on grids as on surfaces.
TEST(GridGrowth, StagesMasksAndCheckpointsWork) {
  const Recipe recipe = parse_recipe(
      "[[stage]]\nname = \"large\"\nmodel = \"turing\"\nsize = \"20px\"\nuntil = 300\n"
      "[[stage]]\nname = \"small\"\nmodel = \"turing\"\nsize = \"9px\"\nuntil = 200\nmask = \"large.b < 4\"\n"
      "pin = { a = 4, b = 4 }\n",
      "test");
  const Grid grid = builtin_grid("builtin:tile?n=64");
  GridRun run(make_program(recipe, grid)), resumed(make_program(recipe, grid));
  run.advance(40);
  resumed.restore(run.checkpoint());
  run.advance(100'000);
  resumed.advance(100'000);
  EXPECT_TRUE(run.done());
  EXPECT_TRUE(run.checkpoint() == resumed.checkpoint());
  const Vector& large = run.finished()[0].fields[1];
  for (Eigen::Index v = 0; v < large.size(); ++v) {
    if (large[v] < 4) {
      EXPECT_EQ(run.coefficients()[1][v], 4);
    }
  }
}

std::string refusal(const std::string& stage, const Grid& grid) {
  try {
    run_on(grid, stage);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GridGrowth, WhatGridsCannotIsRefused) {
  const Grid tile = builtin_grid("builtin:tile?n=32");
  EXPECT_NE(refusal("model = \"turing\"\nmethod = \"loop\"\n", tile).find("is for surfaces"), std::string::npos);
  Recipe moving = parse_recipe("[stage]\nmodel = \"turing\"\n[motion]\ngrowth = 0.1\n", "test");
  EXPECT_THROW(make_program(moving, tile), Error);
  const Recipe lattice = parse_recipe("[stage]\nmodel = \"turing\"\nstepper = \"gaussian\"\n", "test");
  EXPECT_THROW(make_program(lattice, load_shape("builtin:sphere?n=642")), Error);
  const Recipe cells = parse_recipe("[stage]\nmodel = \"turing\"\nsize = \"12px\"\n", "test");
  EXPECT_THROW(make_program(cells, load_shape("builtin:sphere?n=642")), Error);
}

/// The public way.
TEST(GridGrowth, GrowsFromTheOutside) {
  Growth growth(builtin_grid("builtin:tile?n=32"), parse_recipe("[stage]\nmodel = \"turing\"\nsize = \"9px\"\n", "t"));
  growth.advance(20);
  const Grid coat = growth.dress_grid();
  EXPECT_EQ(coat.find("color")->values.size(), 3U * 32 * 32);
  EXPECT_EQ(coat.find("b")->values.size(), 32U * 32);
}

}  // namespace
}  // namespace pelage
