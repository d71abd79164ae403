// Runs with the steppers for even grids, and coarse grids first.

#include <gtest/gtest.h>

#include <cmath>

#include "run/nested.h"
#include "shape/grid.h"
#include "support/model_stage.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

Grid tile(std::int32_t n, bool periodic = true) {
  Grid g;
  g.count = {n, n, 1};
  g.periodic = {periodic, periodic, false};
  g.spacing = {1.0 / (periodic ? n : n - 1), 1.0 / (periodic ? n : n - 1), 1};
  return g;
}

Program program_on(const Grid& grid, const std::string& model, const StepperKind& stepper, double size) {
  Program program;
  program.method = &grid_method;
  program.shape = std::make_shared<const TriangleMesh>(mesh_of(grid));
  program.nodes = std::make_shared<const NodeShape>(grid);
  program.stages.push_back(stage_of(model, stepper, size));
  return program;
}

void finish(Growth& run) {
  while (run.summary().status == RunStatus::running) run.advance(100);
  ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
}

double wavelength(const Growth& run) {
  return measured_wavelength(*run.space().sampled(SampleRule::vertices).mass, *run.space().stiffness(),
                             run.coefficients()[0]);
}

/// Waves that spread exactly make the pattern that finite elements make.
TEST(LatticeGrowth, EtdGrowsWhatFiniteElementsGrow) {
  for (const std::string model : {"schnakenberg", "gierer-meinhardt"}) {
    Growth waves(program_on(tile(64), model, etd, 0.25)), elements(program_on(tile(64), model, rkc2, 0.25));
    finish(waves);
    finish(elements);
    EXPECT_FALSE(waves.uniform());
    EXPECT_NEAR(wavelength(waves) / wavelength(elements), 1, 0.03) << model;
  }
}

/// Errors bound the step of an excitable medium, too.
TEST(LatticeGrowth, EtdKeepsItsErrorWhereReactionsAreFast) {
  Growth run(program_on(tile(48, false), "fitzhugh-nagumo", etd, 0.25));
  run.advance(200);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
}

class EveryLatticeStepper : public ::testing::TestWithParam<const StepperKind*> {};
INSTANTIATE_TEST_SUITE_P(Steppers, EveryLatticeStepper, ::testing::Values(&etd, &gaussian_stepper, &binary_stepper),
                         [](const auto& stepper) { return std::string(stepper.param->name); });

TEST_P(EveryLatticeStepper, StripesComeToRestAtTheirSizeAndCheckpointsHold) {
  const Program program = program_on(tile(64), "witkin-kass-stripes", *GetParam(), 0.2);
  Growth run(program), resumed(program);
  run.advance(3);
  resumed.restore(run.checkpoint());
  finish(run);
  finish(resumed);
  EXPECT_TRUE(run.checkpoint() == resumed.checkpoint());
  EXPECT_TRUE(run.summary().status == RunStatus::stationary || GetParam() != &binary_stepper);
  EXPECT_FALSE(run.uniform());
  EXPECT_NEAR(wavelength(run) / 0.2, 1, 0.15);
}

TEST(LatticeGrowth, WhatAStepperCannotGrowIsRefusedInWords) {
  const auto message = [](const std::string& model, const StepperKind& stepper, bool periodic = true) {
    Growth run(program_on(tile(33, periodic), model, stepper, 0.3));
    run.advance(3);
    EXPECT_EQ(run.summary().status, RunStatus::failed) << model;
    EXPECT_EQ(run.summary().steps, 0);
    return run.summary().message;
  };
  EXPECT_EQ(message("witkin-kass-2", binary_stepper),
            "the stepper \"binary\" cannot grow \"witkin-kass-2\" here: it grows pairs of species, and these are 4; "
            "leave the stepper out");
  EXPECT_NE(message("schnakenberg", binary_stepper).find("decay"), std::string::npos);
}

TEST(Nested, TakesEverySecondNode) {
  const std::optional<Grid> torus = every_second_node(tile(8)), box = every_second_node(tile(9, false));
  ASSERT_TRUE(torus && box);
  EXPECT_EQ(torus->count[0], 4);
  EXPECT_EQ(box->count[1], 5);
  EXPECT_EQ(torus->count[2], 1);
  EXPECT_EQ(torus->spacing[0], 0.25);
  EXPECT_EQ(box->spacing[0], 0.25);
  EXPECT_FALSE(every_second_node(tile(9)));
  EXPECT_FALSE(every_second_node(tile(8, false)));
  EXPECT_FALSE(every_second_node(tile(4)));
}

/// Between the nodes of the coarse grid the start is linear, and it is the coarse pattern.
TEST(Nested, BeginsWithTheCoarsePattern) {
  Growth fine(program_on(tile(64), "schnakenberg", etd, 0.3)), coarse(program_on(tile(32), "schnakenberg", etd, 0.3));
  EXPECT_EQ(grow_nested(fine), 1);  // 9.6 nodes to the wavelength are left, and then 4.8
  finish(coarse);
  for (std::int32_t j = 0; j < 32; ++j)
    for (std::int32_t i = 0; i < 32; ++i) {
      const Vector &u = fine.coefficients()[0], &v = coarse.coefficients()[0];
      ASSERT_NEAR(u[2 * i + 128 * j], v[i + 32 * j], 1e-15);
      ASSERT_NEAR(u[2 * i + 1 + 128 * j], (v[i + 32 * j] + v[(i + 1) % 32 + 32 * j]) / 2, 1e-15);
      ASSERT_NEAR(u[2 * i + 128 * j + 64], (v[i + 32 * j] + v[i + 32 * ((j + 1) % 32)]) / 2, 1e-15);
    }
}

/// The finished pattern has the wavelength that it has without, and takes fewer steps on the fine grid.
TEST(Nested, FinishesSoonerWithTheSameWavelength) {
  for (const bool periodic : {true, false}) {
    const Program program = program_on(tile(periodic ? 96 : 97, periodic), "schnakenberg", rkc2, 0.2);
    Growth plain(program), nested(program);
    EXPECT_EQ(grow_nested(nested), 1);
    finish(plain);
    finish(nested);
    EXPECT_LT(nested.summary().iterations, plain.summary().iterations / 4);
    EXPECT_NEAR(wavelength(nested) / wavelength(plain), 1, 0.1);
  }
}

/// A checkpoint is that of the fine grid: a run that was not nested goes on from it.
TEST(Nested, GoesOnFromACheckpoint) {
  const Program program = program_on(tile(64), "schnakenberg", rkc2, 0.3);
  Growth nested(program), resumed(program);
  EXPECT_EQ(grow_nested(nested), 1);
  nested.advance(5);
  resumed.restore(nested.checkpoint());
  nested.advance(5);
  resumed.advance(5);
  EXPECT_TRUE(nested.checkpoint() == resumed.checkpoint());
}

TEST(Nested, LeavesCoarseGridsAlone) {
  Growth run(program_on(tile(32), "schnakenberg", etd, 0.25));
  const std::vector<Vector> before = run.coefficients();
  EXPECT_EQ(grow_nested(run), 0);
  EXPECT_EQ(run.coefficients(), before);
}

}  // namespace
}  // namespace pelage
