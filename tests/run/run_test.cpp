#include "run/run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "catalog/bind.h"
#include "pelage/error.h"
#include "run/checkpoint.h"
#include "shape/generators.h"
#include "support/steppers.h"

namespace pelage {
namespace {

Recipe small_recipe(const std::string& model = "turing") {
  Recipe recipe;
  recipe.stages[0].model.value = model;
  recipe.stages[0].size = Given<Length>{{0.5}, {}};
  return recipe;
}

Run start(const Recipe& recipe, const std::string& shape = "builtin:sphere?n=362") {
  return Run(make_program(recipe, builtin_shape(shape)));
}

void expect_same(const Run& a, const Run& b) {
  ASSERT_EQ(a.coefficients().size(), b.coefficients().size());
  for (std::size_t i = 0; i < a.coefficients().size(); ++i) EXPECT_EQ(a.coefficients()[i], b.coefficients()[i]);
  EXPECT_EQ(a.summary().time, b.summary().time);
  EXPECT_EQ(a.summary().steps, b.summary().steps);
  EXPECT_EQ(a.summary().step, b.summary().step);
  EXPECT_TRUE(a.checkpoint() == b.checkpoint());
}

class EveryStepper : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Steppers, EveryStepper, ::testing::ValuesIn(stepper_names()),
                         [](const auto& name) { return stepper_test_name(name); });

TEST_P(EveryStepper, TwoSlicesAreOneSliceBitForBit) {
  Recipe recipe = small_recipe();
  recipe.stages[0].stepper.value = GetParam();
  if (GetParam() != "sbdf2") recipe.stages[0].step = 0.02;
  auto whole = start(recipe), sliced = start(recipe), resumed = start(recipe);
  whole.advance(50);
  sliced.advance(20);
  const std::string checkpoint = sliced.checkpoint();
  sliced.advance(30);
  expect_same(whole, sliced);
  resumed.restore(checkpoint);
  resumed.advance(30);
  expect_same(whole, resumed);
  EXPECT_GT((whole.coefficients()[0].array() - whole.coefficients()[0].mean()).matrix().norm(), 0);
}

/// Five steps to a set of matrices: the checkpoint comes between two.
TEST(Run, MatricesThatAreKeptSurviveACheckpoint) {
  Recipe recipe = small_recipe();
  recipe.stages[0].refresh = Given<std::int64_t>{5, {}};  // which asks for the stepper semi-implicit
  recipe.stages[0].step = 0.2;
  auto whole = start(recipe), resumed = start(recipe), renewed = start(small_recipe());
  whole.advance(7);
  resumed.restore(whole.checkpoint());
  whole.advance(6);
  resumed.advance(6);
  expect_same(whole, resumed);
  EXPECT_THROW(renewed.restore(whole.checkpoint()), Error);
}

/// What is only shown is found at the end of every slice, and takes no part in the steps.
TEST(Run, SpeciesThatFollowAreTheirFormulaAndLeaveTheStepsAlone) {
  for (const std::string method : {"remeshed", "loop"}) {
    Recipe recipe = small_recipe("witkin-kass-2");
    recipe.stages[0].method.value = method;
    auto whole = start(recipe), sliced = start(recipe), resumed = start(recipe);
    whole.advance(12);
    sliced.advance(5);
    resumed.restore(sliced.checkpoint());
    sliced.advance(7);
    resumed.advance(7);
    expect_same(whole, sliced);
    expect_same(whole, resumed);
    const SparseMatrix& values = whole.system().sampling->values;
    std::vector<Vector> u;
    for (const Vector& c : whole.coefficients()) u.push_back(values * c);
    const Vector expected = (u[3] - u[2]).cwiseMax(u[1] - u[0]);  // p1 - q1, p2 - q2
    EXPECT_LT((u[4] - expected).norm(), 1e-8 * expected.norm()) << method;
    EXPECT_LE(whole.summary().minimum, minimum(whole.coefficients()[4]));
  }
}

TEST(Run, FortyAndSixtyStepsAreAHundred) {
  auto whole = start(small_recipe()), sliced = start(small_recipe());
  whole.advance(100);
  sliced.advance(40);
  sliced.advance(60);
  expect_same(whole, sliced);
}

TEST(Run, SameBitsForAnyNumberOfThreads) {
  auto several = start(small_recipe(), "builtin:animal?n=2000");
  several.advance(30);
  const ThreadLimit limit(1);
  auto one = start(small_recipe(), "builtin:animal?n=2000");
  one.advance(30);
  expect_same(several, one);
}

TEST(Run, CheckpointAtAnyStepContinuesWithTheSameBits) {
  auto whole = start(small_recipe());
  for (int k = 0; k < 6; ++k) {  // the first steps, when the scheme has less of a past
    auto resumed = start(small_recipe());
    resumed.restore(whole.checkpoint());
    whole.advance(1);
    resumed.advance(1);
    expect_same(whole, resumed);
  }
}

TEST(Run, DamagedCheckpointsAreRefused) {
  auto run = start(small_recipe());
  run.advance(5);
  const std::string good = run.checkpoint();
  const std::vector<Vector> before = run.coefficients();
  EXPECT_THROW(run.restore(""), Error);
  EXPECT_THROW(run.restore("something else"), Error);
  EXPECT_THROW(run.restore(good + "x"), Error);
  for (std::size_t length = 0; length < good.size(); length += 97)
    EXPECT_THROW(run.restore(good.substr(0, length)), Error);
  std::string huge = good.substr(0, good.size() - seal_length);  // a length that no memory holds, well sealed
  for (std::size_t i = 30; i < 38; ++i) huge[i] = '\x7f';
  EXPECT_THROW(run.restore(seal(huge)), Error);
  EXPECT_THROW(start(small_recipe(), "builtin:sphere?n=162").restore(good), Error);
  Recipe recipe = small_recipe();
  recipe.stages[0].stepper.value = "semi-implicit";
  recipe.stages[0].step = 0.02;
  auto other = start(recipe);
  other.advance(2);
  EXPECT_THROW(run.restore(other.checkpoint()), Error);
  EXPECT_EQ(run.coefficients()[0], before[0]);
}

/// Any of them: fields would be others, and nobody would know.
TEST(Run, EveryFlippedBitIsSeen) {
  auto run = start(small_recipe());
  run.advance(5);
  const std::string good = run.checkpoint();
  for (std::size_t k = 0; k < 2000; ++k) {
    const auto bit = static_cast<std::size_t>(uniform(5, k) * 8 * static_cast<double>(good.size()));
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    EXPECT_THROW(run.restore(bad), Error) << bit;
  }
}

TEST(Run, TheFirstDifferenceIsNamed) {
  const Recipe base = small_recipe("schnakenberg");
  Recipe seed = base, method = base, parameter = base, step = base;
  seed.stages[0].seed = 2;
  method.stages[0].method.value = "linear";
  parameter.stages[0].parameters = {{"a", 0.11, {}}};
  step.stages[0].step = 0.01;
  const std::string checkpoint = start(base).checkpoint();
  const auto message = [&](const Recipe& other, const std::string& shape) {
    try {
      start(other, shape).restore(checkpoint);
      return std::string("no error");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  const std::string same = "builtin:sphere?n=362";
  for (const auto& [recipe, words] :
       std::vector<std::pair<Recipe, std::string>>{{seed, "seed 1 instead of 2"},
                                                   {method, "instead of linear"},
                                                   {parameter, "a 0.1 instead of 0.11"},
                                                   {step, "step none instead of 0.01"},
                                                   {small_recipe("brusselator"), "model schnakenberg instead of"}})
    EXPECT_NE(message(recipe, same).find(words), std::string::npos) << message(recipe, same);
  EXPECT_NE(message(base, "builtin:sphere?n=162").find("another shape"), std::string::npos);
}

TEST(Run, ANoteComesBack) {
  auto run = start(small_recipe());
  run.advance(2);
  EXPECT_EQ(note_of_checkpoint(run.checkpoint("what for")), "what for");
  auto other = start(small_recipe());
  other.restore(run.checkpoint("what for"));
  EXPECT_EQ(other.checkpoint(), run.checkpoint());
}

/// Of equal sizes, but another run.
TEST(Run, CheckpointsOfOtherProgramsAreRefused) {
  auto run = start(small_recipe("schnakenberg"));
  run.advance(5);
  const std::string checkpoint = run.checkpoint();
  start(small_recipe("schnakenberg")).restore(checkpoint);
  Recipe seed = small_recipe("schnakenberg"), method = seed, parameter = seed, size = seed;
  seed.stages[0].seed = 2;
  method.stages[0].method.value = "linear";
  parameter.stages[0].parameters = {{"a", 0.11, {}}};
  size.stages[0].size->value.value *= 0.999;
  for (const Recipe& other : {seed, method, parameter, size, small_recipe("brusselator")}) {
    auto another = start(other);
    another.advance(3);
    const std::string before = another.checkpoint();
    EXPECT_THROW(another.restore(checkpoint), Error);
    EXPECT_TRUE(another.checkpoint() == before);
    another.advance(1);  // goes on as if nothing had been
  }
}

TEST(Run, CheckpointsAreLittleEndian) {
  auto run = start(small_recipe());
  run.advance(5);
  const std::string bytes = run.checkpoint("note"), heading = "pelage checkpoint 5\n";
  EXPECT_EQ(bytes.substr(0, heading.size() + 12), heading + std::string("\x04\0\0\0\0\0\0\0note", 12));
}

TEST(Run, SaysWhenNothingHasGrown) {
  Recipe recipe = small_recipe("gray-scott");  // its only state is stable there
  recipe.stages[0].parameters = {{"F", 0.1, {}}, {"k", 0.03, {}}};
  recipe.stages[0].unit = Given<Length>{{0.02}, {}};
  recipe.stages[0].size.reset();
  auto quiet = start(recipe, "builtin:sphere?n=162");
  quiet.advance(100000);
  EXPECT_TRUE(quiet.uniform());
  EXPECT_FALSE(quiet.why_uniform().empty());
  for (const char uniform : quiet.fields().uniform) EXPECT_TRUE(uniform);
  auto grown = start(small_recipe());
  EXPECT_TRUE(grown.uniform());
  grown.advance(100000);
  EXPECT_FALSE(grown.uniform());
}

/// Every number of the history must fit, too: a checkpoint whose earlier states have another size would be read beyond
/// their ends.
TEST(Run, CheckpointsWithADamagedHistoryAreRefused) {
  Recipe recipe = small_recipe();
  recipe.stages[0].stepper.value = "sbdf2";
  auto run = start(recipe);
  run.advance(5);
  const std::string good = run.checkpoint();
  const auto n = static_cast<std::uint64_t>(run.coefficients()[0].size());
  const std::string size(reinterpret_cast<const char*>(&n), sizeof n);
  std::size_t at = good.find(size);
  int seen = 0;
  for (; at != std::string::npos; at = good.find(size, at + 8), ++seen) {
    std::string bad = good.substr(0, at);
    const std::uint64_t less = n - 1;
    bad.append(reinterpret_cast<const char*>(&less), sizeof less);
    bad += good.substr(at + 16);
    EXPECT_THROW(run.restore(bad), Error) << "field " << seen;
  }
  EXPECT_EQ(seen, 2 + 2 * 2 + 2);  // two species: now, two earlier states, and the samples' rates
}

TEST(Run, StopsAfterTheGivenSteps) {
  Recipe recipe = small_recipe();
  recipe.stages[0].steps = 7;
  auto run = start(recipe);
  run.advance(1000);
  EXPECT_EQ(run.summary().status, RunStatus::steps_reached);
  EXPECT_EQ(run.summary().steps, 7);
  EXPECT_EQ(run.fraction(), 1);
  EXPECT_EQ(run.advance(10).steps, 7);
}

TEST(Run, StopsExactlyAtTheGivenTime) {
  Recipe recipe = small_recipe();
  recipe.stages[0].until = 10.1;
  auto run = start(recipe);
  run.advance(100000);
  EXPECT_EQ(run.summary().status, RunStatus::time_reached);
  EXPECT_DOUBLE_EQ(run.summary().time, 10.1);
}

/// The last step is then so short that it says nothing about how fast the pattern changes.
TEST(Run, ReportsTheChangeOfTheLastWholeStepWhereTheEndCutsItShort) {
  const auto change_until = [](double time) {
    Recipe recipe = small_recipe();
    recipe.stages[0].step = 0.5;
    recipe.stages[0].until = time;
    auto run = start(recipe);
    EXPECT_EQ(run.advance(100000).time, time);
    return run.summary().change;
  };
  EXPECT_EQ(change_until(10.001), change_until(10));
  EXPECT_NEAR(change_until(10.4), change_until(10.5), 0.02 * change_until(10.5));
  EXPECT_GT(change_until(0.001), 0);
}

TEST(Run, GivesUpWhereTheStepsAreFarTooShortForTheTime) {
  Recipe recipe = small_recipe("schnakenberg");
  recipe.stages[0].method.value = "loop";
  Program program = make_program(recipe, builtin_shape("builtin:sphere?n=162"));
  program.stages[0].suggested_step = 1000;  // where steps of a half are possible
  program.stages[0].until = 1500;
  program.stages[0].stationary = 0;
  pelage::Run run(std::move(program));
  run.advance(1'000'000);
  EXPECT_EQ(run.summary().status, RunStatus::failed);
  EXPECT_EQ(run.summary().steps, 1151);
  EXPECT_NE(run.summary().message.find("the fields change so fast that the step is"), std::string::npos)
      << run.summary().message;
}

TEST(Run, StopsWhenThePatternRests) {
  auto run = start(small_recipe());
  run.advance(100000);
  EXPECT_EQ(run.summary().status, RunStatus::stationary);
  EXPECT_LT(run.summary().change, run.stage_program().stationary);
  const Vector before = run.coefficients()[0];
  Recipe longer = small_recipe();
  longer.stages[0].stationary = 0;
  longer.stages[0].until = run.summary().time + 100;
  auto on = start(longer);
  on.restore(run.checkpoint());
  on.advance(100000);
  const double spread = before.maxCoeff() - before.minCoeff();
  EXPECT_LT((on.coefficients()[0] - before).cwiseAbs().maxCoeff(), 0.05 * spread);
}

TEST(Run, AFixedStepThatIsTooLargeFailsWithAMessage) {
  Recipe recipe = small_recipe();
  recipe.stages[0].stepper.value = "explicit";
  recipe.stages[0].step = 3;
  auto run = start(recipe);
  run.advance(10000);
  EXPECT_TRUE(run.done());
  EXPECT_EQ(run.summary().status, RunStatus::failed);
  EXPECT_NE(run.summary().message.find("step"), std::string::npos) << run.summary().message;
  EXPECT_NE(run.summary().message.find("halve"), std::string::npos) << run.summary().message;
  for (const Vector& u : run.coefficients()) EXPECT_TRUE(u.allFinite());
}

/// The error estimate alone must find the step: with clamped species, whose kinetics shoot below zero, and from the
/// first step on, when there is no history to estimate from. Unstable waves amplify the differences to some percent.
TEST(Run, AStepLimitFarTooLargeChangesLittle) {
  for (const char* model : {"thomas", "brusselator", "klausmeier", "lengyel-epstein"}) {
    Program usual = make_program(small_recipe(model), builtin_shape("builtin:sphere?n=162"));
    usual.stages[0].until = 20;
    Program unlimited = usual;
    unlimited.stages[0].suggested_step *= 1000;
    pelage::Run a(std::move(usual)), b(std::move(unlimited));
    a.advance(100000);
    b.advance(100000);
    ASSERT_EQ(b.summary().status, RunStatus::time_reached) << model << ": " << b.summary().message;
    for (std::size_t i = 0; i < a.coefficients().size(); ++i)
      EXPECT_LT((a.coefficients()[i] - b.coefficients()[i]).norm(), 0.1 * a.coefficients()[i].norm()) << model;
  }
}

TEST(Run, OtherSeedsMakeOtherPatterns) {
  Recipe recipe = small_recipe();
  auto first = start(recipe);
  recipe.stages[0].seed = 2;
  auto second = start(recipe);
  first.advance(20);
  second.advance(20);
  EXPECT_NE(first.coefficients()[0], second.coefficients()[0]);
}

TEST(Run, MeasuresTheWavelengthOfASingleWave) {
  auto run = start(small_recipe(), "builtin:sphere?n=2562");
  Vector z(run.space().unknowns());
  for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = run.space().control()[static_cast<std::size_t>(i)][2];
  double radius = 0;
  for (const Point& p : run.space().geometry(SampleRule::vertices, false).position)
    radius = std::hypot(p[0], p[1], p[2]);
  // Degree 1: k = sqrt(2) / radius.
  EXPECT_NEAR(
      measured_wavelength(*run.system().mass, *run.space().stiffness(), z) / (2 * M_PI * radius / std::sqrt(2.0)), 1,
      2e-3);
}

}  // namespace
}  // namespace pelage
