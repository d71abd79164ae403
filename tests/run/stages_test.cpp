#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalog/bind.h"
#include "pelage/error.h"
#include "pelage/named_files.h"
#include "run/directions.h"
#include "run/random_points.h"
#include "run/run.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

const char* two_stages = R"~(
[[stage]]
name = "large"
model = "turing"
size = 0.4
steps = 60

[[stage]]
name = "small"
model = "turing"
size = 0.3
mask = "large.b < 4"
pin = { a = 4 }
initial = { b = "4 + 0.1*large.b" }
steps = 40
)~";

Growth start(const std::string& recipe, const std::string& shape = "builtin:sphere?n=642") {
  return Growth(make_program(parse_recipe(recipe, "test.toml"), builtin_shape(shape)));
}

Growth finished(const std::string& recipe, const std::string& shape = "builtin:sphere?n=642") {
  Growth run = start(recipe, shape);
  while (!run.done()) run.advance(100);
  EXPECT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  return run;
}

std::string message_of(const std::string& recipe) {
  try {
    start(recipe);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// One stage of pure diffusion from a step at the equator.
std::string diffusion(const std::string& more) {
  return "[stage]\nmodel = \"" + std::string(PELAGE_BINARY_DIR) +
         "/stage-diffusion.toml\"\nmethod = \"loop\"\nsize = 0.5\n" + more;
}

class DiffusionModel : public ::testing::Test {
 protected:
  void SetUp() override {
    FILE* file = std::fopen((std::string(PELAGE_BINARY_DIR) + "/stage-diffusion.toml").c_str(), "w");
    ASSERT_TRUE(file);
    std::fputs(
        "name = \"diffusion\"\nwavelength = 1\n[species.u]\ndiffusion = \"D\"\nrate = \"0\"\n"
        "initial = \"if(z > 0, 2, 1)\"\n[parameters]\nD = 1\n[suggested]\nstep = 0.01\nend = 0.5\n",
        file);
    std::fclose(file);
    allow_outside_files(true);  // the text of a test lies nowhere
  }
  void TearDown() override { allow_outside_files(false); }
};

TEST(Stages, SlicesAndCheckpointsInsideTheSecondStageKeepTheBits) {
  Growth whole = start(two_stages), sliced = start(two_stages);
  whole.advance(100);
  EXPECT_TRUE(whole.done());
  EXPECT_EQ(whole.stage(), 1);
  for (const std::int64_t steps : {60, 17}) {  // the end of the first stage, and inside the second
    sliced.advance(steps);
    Growth resumed = start(two_stages);
    resumed.restore(sliced.checkpoint());
    EXPECT_TRUE(resumed.checkpoint() == sliced.checkpoint());
    resumed.advance(1000);
    EXPECT_TRUE(resumed.checkpoint() == whole.checkpoint());
  }
  EXPECT_EQ(sliced.stage(), 1);
  sliced.advance(1000);
  EXPECT_TRUE(sliced.checkpoint() == whole.checkpoint());
}

/// Where progress asks to stop while a stage begins, the run stays at the end of the one before.
TEST(Stages, BeginWithProgressAndCanBeCancelled) {
  bool stop = false;
  std::string seen;
  const Progress progress = [&](std::string_view what, double) {
    seen += std::string(what) + "\n";
    return !(stop && what.starts_with("stage small"));
  };
  Growth run(make_program(parse_recipe(two_stages, "test.toml"), builtin_shape("builtin:sphere?n=642")), progress);
  EXPECT_NE(seen.find("stage large: sampling"), std::string::npos);
  stop = true;
  run.advance(60);
  const std::string before = run.checkpoint();
  try {
    run.advance(1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::cancelled);
  }
  EXPECT_TRUE(run.checkpoint() == before);
  stop = false;
  run.advance(1000);
  Growth whole = start(two_stages);
  whole.advance(1000);
  EXPECT_TRUE(run.checkpoint() == whole.checkpoint());
}

/// Oscillations do not settle: the stage ends at its time, and the next one begins.
TEST(Stages, OneThatNeverComesToRestEndsAtItsTime) {
  Growth run = start(
      "[[stage]]\nname = \"restless\"\nmodel = \"lambda-omega\"\nsize = 0.5\nstationary = 1e-3\nuntil = 5\n"
      "[[stage]]\nmodel = \"turing\"\nsize = 0.5\nsteps = 5\ninitial = { b = \"4 + 0.1*restless.u\" }\n");
  run.advance(100000);
  ASSERT_TRUE(run.done());
  EXPECT_EQ(run.stage(), 1);
  EXPECT_EQ(run.finished().front().summary.status, RunStatus::time_reached);
  EXPECT_NEAR(run.finished().front().summary.time, 5, 1e-9);
  EXPECT_EQ(run.summary().status, RunStatus::steps_reached);
}

TEST(Stages, FrozenCoefficientsStayAndTheOthersGrow) {
  Growth run = start(two_stages);
  run.advance(61);
  const Growth::FinishedStage& large = run.finished().front();
  const Vector b = run.space().node_values() * large.fields[1];
  const Vector before = run.coefficients()[1];
  run.advance(1000);
  const Vector& after = run.coefficients()[1];
  int frozen = 0;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    EXPECT_EQ(after[i] == before[i], b[i] < 4) << i;
    frozen += b[i] < 4;
  }
  EXPECT_GT(frozen, b.size() / 20);
  EXPECT_LT(frozen, b.size() / 2);
}

TEST(Stages, AMaskOfNothingChangesNoBitAndOneOfEverythingNothingMoves) {
  const std::string plain = "[stage]\nmodel = \"turing\"\nsize = 0.5\nsteps = 20\n";
  const Growth free = finished(plain), nothing = finished(plain + "mask = \"x > 100\"\n"),
               all = finished(plain + "mask = \"x < 100\"\n");
  EXPECT_EQ(free.coefficients(), nothing.coefficients());
  EXPECT_EQ(free.summary().step, nothing.summary().step);
  EXPECT_EQ(all.coefficients(), all.initial());
}

TEST(Stages, PinnedValuesAreThoseOfThePins) {
  const Growth run =
      finished("[stage]\nmodel = \"turing\"\nsize = 0.5\nsteps = 20\nmask = \"z > 0.2\"\npin = { b = \"3 + z\" }\n");
  const Vector b = run.space().node_values() * run.coefficients()[1];
  const auto& position = run.system().sampling->position;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (position[i][2] < 0.7) continue;  // less than two rings inside
    EXPECT_NEAR(b[static_cast<Eigen::Index>(i)], 3 + position[i][2], 1e-8);
  }
}

/// Samples at least four edges below or above the equator, further than basis functions reach across it.
std::vector<double> samples_away_from_the_equator(const Run& run, bool above) {
  const Vector u = run.space().node_values() * run.coefficients()[0];
  const auto& position = run.system().sampling->position;
  std::vector<double> samples;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (above ? position[i][2] > 0.3 : position[i][2] < -0.3) samples.push_back(u[static_cast<Eigen::Index>(i)]);
  return samples;
}

TEST_F(DiffusionModel, NothingPassesTheBorderOfAnExcludedRegion) {
  const auto below = [](const std::string& more) {
    const Growth run = finished(diffusion(more), "builtin:sphere?n=2562");
    if (!more.starts_with("until")) {
      for (const double u : samples_away_from_the_equator(run, true)) EXPECT_NEAR(u, 2, 1e-3);
    }
    const auto [low, high] = std::ranges::minmax(samples_away_from_the_equator(run, false));
    EXPECT_NEAR(low, high, 1e-3);
    return low;
  };
  const std::string cut = "mask = \"z > 0\"\ninside = \"excluded\"\nuntil = ";
  const double early = below(cut + "2"), late = below(cut + "10");
  EXPECT_NEAR(early, 1, 0.06);                 // the elements that the border crosses had values between 1 and 2
  EXPECT_NEAR(late, early, 0.01);              // ripples of the cut elements settle slowly
  EXPECT_NEAR(below("until = 2"), 1.5, 0.01);  // without the mask
}

TEST_F(DiffusionModel, FrozenRegionsFeedTheirSurroundings) {
  const Growth run = finished(diffusion("mask = \"z > 0\"\ninitial = { u = 1 }\npin = { u = 2 }\nuntil = 20\n"),
                              "builtin:sphere?n=2562");
  for (const double u : samples_away_from_the_equator(run, false)) EXPECT_NEAR(u, 2, 0.02);
}

TEST_F(DiffusionModel, AMapOfAConstantIsThatConstant) {
  // With a size, a number would not change what diffuses how far: the unit follows it.
  const auto by_unit = [](const std::string& more) {
    std::string stage = diffusion(more);
    return stage.replace(stage.find("size = "), 4, "unit");
  };
  const Growth number = finished(by_unit("parameters = { D = 4 }\n")),
               formula = finished(by_unit("parameters = { D = \"2*2\" }\n")),
               size = finished(by_unit("size-map = \"2\"\n"));
  EXPECT_EQ(number.coefficients(), formula.coefficients());
  // a map of the size also makes a finer mesh; both are about the same function
  EXPECT_NEAR(number.coefficients()[0].maxCoeff(), size.coefficients()[0].maxCoeff(), 1e-3);
}

TEST(Stages, FieldsAreCarriedOver) {
  const std::string recipe = std::string(two_stages) + R"~(
[[stage]]
model = "turing"
from = "small"
size = 0.4
steps = 0
)~";
  const Growth run = finished(recipe);
  const auto& small = run.finished()[1].fields;
  for (std::size_t i = 0; i < small.size(); ++i)
    EXPECT_LT((run.coefficients()[i] - small[i]).norm(), 1e-8 * small[i].norm());
  const CoatFields fields = run.fields();
  EXPECT_EQ(fields.species, (std::vector<std::string>{"large.a", "large.b", "small.a", "small.b", "a", "b"}));
}

TEST(Stages, FaultsAreLocated) {
  const std::string first = "[[stage]]\nname = \"one\"\nmodel = \"turing\"\n",
                    second = "[[stage]]\nmodel = \"turing\"\n";
  EXPECT_EQ(message_of(first + second + "from = \"onne\"\n"),
            "test.toml:6:8: unknown earlier stage \"onne\"; did you mean \"one\"? known: one");
  EXPECT_NE(message_of(first + second + "mask = \"one.c < 4\"\n").find("test.toml:6:9: there is no field \"one.c\""),
            std::string::npos);
  EXPECT_NE(message_of(first + second + "pin = { c = 4 }\n").find("test.toml:6:13: unknown species \"c\""),
            std::string::npos);
  EXPECT_NE(message_of(first + second + "pin = { b = 4 }\n").find("nothing to pin without a mask"), std::string::npos);
  EXPECT_NE(message_of(first + second + "initial = { b = \"a\" }\n").find("cannot depend on species"),
            std::string::npos);
  EXPECT_NE(message_of(first + second + "mask = \"b > 1\"\n").find("cannot depend on them"), std::string::npos);
  EXPECT_NE(message_of(first + second + "name = \"one\"\n").find("two stages are called"), std::string::npos);
  EXPECT_NE(message_of(first + second + "inside = \"frosen\"\n").find("did you mean \"frozen\""), std::string::npos);
  EXPECT_NE(message_of(first + second + "method = \"linear\"\n").find("all stages have the method"), std::string::npos);
  EXPECT_NE(message_of(first + "mask = \"x > 0\"\nstepper = \"paper\"\n").find("cannot hold parts"), std::string::npos);
  EXPECT_NE(message_of(first + "directions = { axis = [0, 1, 0] }\n").find("diffuses the same in all directions"),
            std::string::npos);
  EXPECT_NE(message_of(first + "directions = { axis = [0, 1] }\n").find("an axis is [X, Y, Z]"), std::string::npos);
  const std::string striped = "[stage]\nmodel = \"witkin-kass-stripes\"\nsize = 0.3\n";
  EXPECT_NE(message_of(striped + "directions = { across = true }\n").find("follow an axis"), std::string::npos);
  EXPECT_NE(message_of(striped + "directions = { from = \"x < 0\" }\n").find("both \"from\" and \"to\""),
            std::string::npos);
  EXPECT_NE(message_of(striped + "directions = { from = \"x < 0\", to = \"bx > 2\" }\n").find("marks no vertex"),
            std::string::npos);
  EXPECT_NE(message_of(striped + "directions = { strokes = [[[0, 0], [1, 1]]] }\n").find("a point of a stroke is"),
            std::string::npos);
  EXPECT_NE(message_of(first + "size-map = \"z\"\n").find("must be greater than 0"), std::string::npos);
  EXPECT_NE(message_of(first + "parameters = { ss = \"x\" }\n").find("unknown parameter \"ss\""), std::string::npos);
  EXPECT_NE(message_of(first + "[[look.layers]]\ncolor = \"#12\"\n").find("test.toml:5"), std::string::npos);
  EXPECT_NE(message_of(first + "[[look.layers]]\ncolor = \"#123456\"\nopacity = \"one.b + c\"\n").find("test.toml:6"),
            std::string::npos);
}

/// On a square the way from one side to the other, an axis and a stroke all ask for the same lines.
TEST(Directions, OfAStageFollowAxisGradientAndStrokes) {
  const TriangleMesh square = builtin_shape("builtin:plane?n=400");
  const auto lines = [&](const std::string& directions) {
    const Recipe recipe =
        parse_recipe("[stage]\nmodel = \"witkin-kass-stripes\"\nsize = 0.3\ndirections = " + directions, "test.toml");
    return vertex_lines(square, make_program(recipe, square).stages[0].directions,
                        make_topology(square.points.size(), square.triangles));
  };
  const auto expect_along = [](const std::vector<Tensor>& found, double xx, double yy) {
    for (const Tensor& t : found) {
      EXPECT_NEAR(t[0], xx, 1e-9);
      EXPECT_NEAR(t[3], yy, 1e-9);
    }
  };
  expect_along(lines("{ axis = [1, 0, 0] }"), 1, 0);
  expect_along(lines("{ from = \"bx < -0.99\", to = \"bx > 0.99\" }"), 1, 0);
  expect_along(lines("{ from = \"bx < -0.99\", to = \"bx > 0.99\", across = true }"), 0, 1);
  expect_along(lines("{ strokes = [[[0.5, 0.1, 0], [0.5, 0.9, 0]]] }"), 0, 1);
}

TEST(RandomPoints, KeepTheirDistanceAndLeaveNoGap) {
  const auto positions = builtin_shape("builtin:torus?n=2000").points;
  const double spacing = 0.3;
  const std::vector<double> distance = distance_to_random_points(positions, spacing, 1);
  std::vector<Point> chosen;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_LT(distance[i], 1);
    if (distance[i] == 0) chosen.push_back(positions[i]);
  }
  EXPECT_GT(chosen.size(), 20);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(length(difference(chosen[i], chosen[j])), spacing);
  EXPECT_NE(distance, distance_to_random_points(positions, spacing, 2));
}

std::vector<Point> tile_of_nodes(int n) {
  std::vector<Point> tile;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) tile.push_back({i / double(n), j / double(n), 0});
  return tile;
}

TEST(JitteredDiamonds, AreAGridOnItsCornerWithoutJitterAndNoFurtherOffThanItSays) {
  constexpr int n = 40, diamonds = 4;
  const std::vector<Point> tile = tile_of_nodes(n);
  const double spacing = std::numbers::sqrt2 / 2 / diamonds;
  const auto distance = [&](double asked, double jitter, std::uint64_t seed) {
    return distance_to_jittered_diamonds(tile, asked, jitter, seed, {1, 1, 0});
  };
  const std::vector<double> regular = distance(spacing, 0, 1);
  for (std::size_t v = 0; v < tile.size(); ++v) {
    double nearest = 1;
    for (const double at : {0.25, 0.75}) {
      const double x = std::remainder(diamonds * tile[v][0] - at, 1), y = std::remainder(diamonds * tile[v][1] - at, 1);
      nearest = std::min(nearest, std::hypot(x, y));
    }
    EXPECT_NEAR(regular[v], nearest / diamonds / spacing, 1e-12);
  }
  // Whole diamonds fit into the period whatever was asked for.
  const std::vector<double> fitted = distance(1.1 * spacing, 0, 1);
  for (std::size_t v = 0; v < tile.size(); ++v) EXPECT_NEAR(1.1 * fitted[v], regular[v], 1e-12);
  constexpr double jitter = 0.6;
  const std::vector<double> disturbed = distance(spacing, jitter, 1);
  double largest = 0;
  for (std::size_t v = 0; v < tile.size(); ++v) largest = std::max(largest, std::abs(disturbed[v] - regular[v]));
  EXPECT_LE(largest, jitter / std::numbers::sqrt2);
  EXPECT_GT(largest, 0.6 * jitter / std::numbers::sqrt2);
  EXPECT_NE(disturbed, distance(spacing, jitter, 2));
  EXPECT_EQ(distance(1e-9, jitter, 1), std::vector<double>(tile.size(), 0));
}

/// On a tile the nearest point may lie beyond the border.
TEST(RandomPoints, RepeatWhereSpaceDoes) {
  constexpr int n = 24;
  const std::vector<Point> tile = tile_of_nodes(n);
  constexpr double spacing = 0.2;
  const std::vector<double> distance = distance_to_random_points(tile, spacing, 3, {1, 1, 0});
  std::vector<Point> chosen;
  for (std::size_t v = 0; v < tile.size(); ++v)
    if (distance[v] == 0) chosen.push_back(tile[v]);
  ASSERT_GT(chosen.size(), 10U);
  const auto around = [](const Point& a, const Point& b) {
    const auto away = [&](std::size_t k) { return std::min(std::abs(a[k] - b[k]), 1 - std::abs(a[k] - b[k])); };
    return std::hypot(away(0), away(1));
  };
  for (std::size_t v = 0; v < tile.size(); ++v) {
    double nearest = 1;
    for (const Point& c : chosen) nearest = std::min(nearest, around(tile[v], c));
    EXPECT_NEAR(distance[v], nearest / spacing, 1e-12);
    EXPECT_LT(distance[v], 1);
  }
  for (std::size_t a = 0; a < chosen.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_GE(around(chosen[a], chosen[b]), spacing - 1e-12);
}

/// Neither where the surface lies nor how fine the points are asked for has a limit.
TEST(RandomPoints, FarAwayAndFinerThanAnyMesh) {
  std::vector<Point> positions = builtin_shape("builtin:torus?n=2000").points;
  for (Point& p : positions)
    for (double& x : p) x = std::round(x * 1024) / 1024;  // exact after the shift
  const std::vector<double> here = distance_to_random_points(positions, 0.3, 1);
  for (const double spacing : {1e-300, 1e-20, 1e-9})
    EXPECT_EQ(distance_to_random_points(positions, spacing, 1), std::vector<double>(positions.size(), 0)) << spacing;
  std::vector<Point> away = positions;
  for (Point& p : away)
    for (double& x : p) x += 0x1p40;
  EXPECT_EQ(distance_to_random_points(away, 0.3, 1), here);
  for (Point& p : away)
    for (double& x : p) x *= 1e290;
  EXPECT_EQ(distance_to_random_points(away, 1e-300, 1), std::vector<double>(positions.size(), 0));
}

}  // namespace
}  // namespace pelage
