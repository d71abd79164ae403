#include "run/moving_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/box.h"
#include "catalog/bind.h"
#include "catalog/models.h"
#include "fair/noisy.h"
#include "pelage/error.h"
#include "run/run.h"

namespace pelage {
namespace {

using testing::with_noise;
using Growth = Run;  // in a test, Run is a function of its own

Recipe moving_recipe(double size = 0.5) {
  Recipe recipe;
  recipe.stages[0].size = Given<Length>{{size, Length::Unit::world}, {}};
  return recipe;
}

Recipe fairing_recipe(std::int64_t every) {
  Recipe recipe = moving_recipe();
  recipe.motion.fair = {"guided", {}};
  recipe.motion.every = every;
  return recipe;
}

TriangleMesh noisy_sphere(const std::string& n = "362") {
  return with_noise(builtin_shape("builtin:sphere?n=" + n), 0.2);
}

TEST(MovingSurface, EndsWhereFairingAloneEnds) {
  const TriangleMesh noisy = noisy_sphere();
  Growth run(make_program(fairing_recipe(2), noisy));
  while (run.world().surface()->moving() && !run.done()) run.advance(1);
  EXPECT_EQ(run.world().surface()->points(), fair(noisy).mesh.points);
  EXPECT_EQ(run.fields().points, fair(noisy).mesh.points);
}

TEST(MovingSurface, SlicesAndCheckpointsKeepTheBits) {
  for (const char* mode : {"texture", "physical"})
    for (const char* stepper : {"sbdf2", "semi-implicit", "explicit"}) {
      Recipe recipe = fairing_recipe(3);
      recipe.motion.mode.value = mode;
      recipe.motion.growth = 1e-4;
      recipe.stages[0].stepper.value = stepper;
      recipe.stages[0].size = Given<Length>{{2, Length::Unit::world}, {}};
      if (recipe.stages[0].stepper.value != "sbdf2") recipe.stages[0].step = 0.02;
      const auto start = [&] { return Growth(make_program(recipe, noisy_sphere("162"))); };
      Growth whole = start(), sliced = start(), resumed = start();
      whole.advance(7);
      sliced.advance(4);  // between two moves
      resumed.restore(sliced.checkpoint());
      sliced.advance(3);
      resumed.advance(3);
      EXPECT_TRUE(whole.checkpoint() == sliced.checkpoint()) << mode << ' ' << stepper;
      EXPECT_TRUE(whole.checkpoint() == resumed.checkpoint()) << mode << ' ' << stepper;
      EXPECT_EQ(whole.amounts(), resumed.amounts()) << mode << ' ' << stepper;
    }
}

TEST(MovingSurface, CheckpointsOfRunsAtRestAreRefused) {
  Growth moving(make_program(fairing_recipe(3), noisy_sphere())),
      resting(make_program(moving_recipe(), noisy_sphere()));
  moving.advance(2);
  resting.advance(2);
  EXPECT_THROW(moving.restore(resting.checkpoint()), Error);
  EXPECT_THROW(resting.restore(moving.checkpoint()), Error);
}

/// A source and a decay, du/dt = a - b u, on a sphere of radius exp(g t): the amount m obeys m' = a A(t) - b m with
/// A = 4 pi exp(2 g t) when amounts ride along, and the value obeys u' = a - b u when values do.
constexpr double a = 0.3, b = 0.2, g = 0.05, until = 8, u0 = 2;

Program growing_sphere(const std::string& mode, double step) {
  Recipe recipe = moving_recipe(2);
  recipe.motion.growth = g;
  recipe.motion.mode.value = mode;
  recipe.motion.every = 1;
  recipe.stages[0].step = step;
  recipe.stages[0].until = until;
  Program program = make_program(recipe, builtin_shape("builtin:sphere?n=642"));
  program.stages[0].model =
      compile(parse_model("name = \"source\"\ntitle = \"source and decay\"\ncite = \"none\"\n"
                          "[species.u]\nrate = \"0.3 - 0.2*u\"\ndiffusion = \"0.01\"\ninitial = \"2\"\n",
                          "source.toml"));
  program.stages[0].stationary = 0;
  return program;
}

double area(const Growth& run) {
  const SparseMatrix& mass = *run.system().mass;
  return (mass * Vector::Ones(mass.rows())).sum();
}

double amount_error(double step) {
  Growth run(growing_sphere("physical", step));
  const double initial_area = area(run);
  run.advance(100000);
  const double c = a / (b + 2 * g);
  const double theory = initial_area * (c * std::exp(2 * g * until) + (u0 - c) * std::exp(-b * until));
  EXPECT_NEAR(area(run) / initial_area, std::exp(2 * g * until), 1e-9);
  return std::abs(run.amounts()[0] / theory - 1);
}

TEST(MovingSurface, AmountsOnAGrowingSphereFollowTheory) {
  const double coarse = amount_error(0.2), fine = amount_error(0.1);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse / fine, 3.4);  // second order in time, as on a surface at rest
}

TEST(MovingSurface, ValuesOfATextureDoNotKnowOfGrowth) {
  Growth run(growing_sphere("texture", 0.1));
  run.advance(100000);
  const double theory = a / b + (u0 - a / b) * std::exp(-b * until);
  EXPECT_NEAR(run.coefficients()[0].minCoeff(), theory, 1e-3);
  EXPECT_NEAR(run.coefficients()[0].maxCoeff(), theory, 1e-3);
}

TEST(MovingSurface, MovingAloneKeepsEveryAmount) {
  Recipe recipe = fairing_recipe(1);
  recipe.motion.mode.value = "physical";
  Program program = make_program(recipe, noisy_sphere("642"));
  program.stages[0].model =
      compile(parse_model("name = \"still\"\ntitle = \"diffusion alone\"\ncite = \"none\"\n"
                          "[species.u]\nrate = \"0\"\ndiffusion = \"0.01\"\ninitial = \"1 + noise(1)\"\n",
                          "still.toml"));
  Growth run(std::move(program));
  const double before = run.amounts()[0];
  run.advance(40);
  EXPECT_FALSE(run.world().surface()->moving());
  EXPECT_NEAR(run.amounts()[0] / before, 1, 1e-6);
}

double grown_wavelength(Program program) {
  Growth run(std::move(program));
  run.advance(100000);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  return measured_wavelength(*run.system().mass, *run.space().stiffness(), run.coefficients()[0]);
}

TEST(MovingSurface, ThePatternOfANoisyShapeHasTheSpacingOfTheCleanOne) {
  const TriangleMesh clean = builtin_shape("builtin:animal?n=1000");
  const double size = 0.2 * box_of(clean.points).diagonal();
  Recipe recipe = moving_recipe(size);
  const double wanted = grown_wavelength(make_program(recipe, clean));
  recipe.motion.fair = {"guided", {}};
  EXPECT_NEAR(grown_wavelength(make_program(recipe, with_noise(clean, 0.2))) / wanted, 1, 0.05) << wanted / size;
}

TEST(MovingSurface, TheMeshIsMadeForTheLargestSize) {
  Recipe recipe = moving_recipe(2);
  recipe.stages[0].until = 1000;
  const Program still = make_program(recipe, noisy_sphere());
  recipe.motion.growth = 2e-3;
  const Program growing = make_program(recipe, noisy_sphere());
  EXPECT_NEAR(still.edge / growing.edge, std::exp(2.0), 1e-9);
  const auto levels = [](const Program& p) { return World(std::make_shared<const Program>(p)).levels(); };
  EXPECT_GT(levels(growing), levels(still));
}

/// u' = f, without diffusion, on a sphere that grows or stays: with values that ride along, the same at every vertex.
Vector accumulated(const std::string& rate, const std::string& more, double growth) {
  Recipe recipe =
      parse_recipe("[stage]\nmodel = \"turing\"\nsize = \"2u\"\nstep = 0.5\nuntil = 10\n" + more, "test.toml");
  recipe.motion.growth = growth;
  recipe.motion.every = 2;
  Program program = make_program(recipe, builtin_shape("builtin:sphere?n=362"));
  ModelChanges changes;
  if (recipe.stages[0].mask) changes.mask = Formula{recipe.stages[0].mask->value, {}};
  changes.excluded = program.stages[0].excluded;
  program.stages[0].model = compile(
      parse_model("name = \"sum\"\n[species.u]\nrate = \"" + rate + "\"\ndiffusion = 0\ninitial = 1\n", "sum.toml"), {},
      changes);
  program.stages[0].stationary = 0;
  program.edge = 1e9;
  Growth run(std::move(program));
  run.advance(1000);
  EXPECT_EQ(run.summary().status, RunStatus::time_reached);
  return run.coefficients()[0];
}

/// White noise used to be drawn anew at every move, and smooth noise stayed where the surface had been.
TEST(MovingSurface, CarriesRandomFieldsAlong) {
  for (const char* rate : {"uniform(0, 1)", "normal(0, 1)", "noise(0.3)"}) {
    const Vector still = accumulated(rate, "", 0), moved = accumulated(rate, "", 0.05);
    EXPECT_GT((still.array() - still.mean()).matrix().norm(), 0.1 * still.norm()) << rate;
    EXPECT_LT((still - moved).norm(), 1e-4 * still.norm()) << rate;
  }
}

/// A mask of coordinates used to move over the surface while what it held stayed.
TEST(MovingSurface, CarriesMasksAlong) {
  for (const char* inside : {"frozen", "excluded"}) {
    const std::string mask = "mask = \"z > 0.3\"\ninside = \"" + std::string(inside) + "\"\n";
    const Vector still = accumulated("1", mask, 0), moved = accumulated("1", mask, 0.05);
    EXPECT_GT(still.maxCoeff() - still.minCoeff(), 5) << inside;
    EXPECT_LT((still - moved).norm(), 1e-4 * still.norm()) << inside;
  }
}

TEST(MovingSurface, ImpossibleMotionsAreRefused) {
  Recipe recipe = moving_recipe();
  recipe.motion.growth = 1;
  EXPECT_THROW(make_program(recipe, noisy_sphere()), Error);
  recipe.motion.growth = 0;
  recipe.motion.mode.value = "phisical";
  EXPECT_THROW(make_program(recipe, noisy_sphere()), Error);
  recipe = fairing_recipe(1);
  recipe.motion.fair->value = "gided";
  EXPECT_THROW(make_program(recipe, noisy_sphere()), Error);
}

TEST(MovingSurface, RecipesNameTheMotion) {
  const std::string stage = "[stage]\nmodel = \"turing\"\n[motion]\n";
  EXPECT_EQ(parse_recipe(stage + "fair = true", "r.toml").motion.fair->value, "guided");
  EXPECT_EQ(parse_recipe(stage + "fair = \"paper\"\nevery = 5", "r.toml").motion.every, 5);
  EXPECT_FALSE(parse_recipe(stage + "fair = false\nmode = \"physical\"", "r.toml").motion.fair);
  EXPECT_THROW(parse_recipe(stage + "every = 0", "r.toml"), Error);
  EXPECT_THROW(parse_recipe(stage + "grow = 0.1", "r.toml"), Error);
}

}  // namespace
}  // namespace pelage
