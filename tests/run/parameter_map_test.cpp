#include "run/parameter_map.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>

#include "base/parallel.h"
#include "catalog/models.h"
#include "pelage/error.h"
#include "react/turing_conditions.h"

namespace pelage {
namespace {

/// Diffusion ratios on both sides of the threshold at 8.5676 (closed form, see the test of Turing conditions), on small
/// squares.
MapRequest schnakenberg_map() {
  MapRequest request;
  request.model = load_model("schnakenberg");
  request.settings = {{"a", 0.1}};
  request.x = {"d", 4, 16, 4};
  request.y = {"b", 0.9, 0.9, 1};
  request.side = 25;
  request.until = 120;
  request.species = 1;
  return request;
}

TEST(ParameterMap, PatternExactlyAboveTheThreshold) {
  const ParameterMap map = run_map(schnakenberg_map());
  ASSERT_EQ(map.cells.size(), 4u);
  for (const MapCell& cell : map.cells) {
    EXPECT_EQ(cell.outcome, cell.x > 8.5676 ? CellOutcome::pattern : CellOutcome::uniform) << cell.x;
    EXPECT_EQ(cell.outcome == CellOutcome::pattern, regime_of(cell.linear) == Regime::turing);
  }
}

TEST(ParameterMap, SameBitsForAnyNumberOfThreads) {
  MapRequest request = schnakenberg_map();
  request.until = 5;
  const ParameterMap many = run_map(request);
  const ThreadLimit one(1);
  const ParameterMap single = run_map(request);
  for (std::size_t c = 0; c < many.cells.size(); ++c)
    EXPECT_EQ(many.cells[c].fields.coefficients, single.cells[c].fields.coefficients);
}

/// Kept cells come back as they were, and are not run again: no time step is made, which the progress would tell.
TEST(ParameterMap, GoesOnFromCellsThatAreKept) {
  MapRequest request = schnakenberg_map();
  request.until = 5;
  std::mutex mutex;
  std::map<std::size_t, std::string> kept;
  MapParts parts;
  parts.keep = [&](std::size_t cell, const std::string& bytes) {
    const std::lock_guard lock(mutex);
    kept[cell] = bytes;
  };
  const ParameterMap whole = run_map(request, {}, parts);
  ASSERT_EQ(kept.size(), 4U);
  std::string last = std::exchange(kept[3], "not what was kept");
  parts.find = [&](std::size_t cell) { return std::optional(kept.at(cell)); };
  std::set<std::size_t> anew;
  parts.keep = [&](std::size_t cell, const std::string& bytes) {
    EXPECT_EQ(bytes, last);
    anew.insert(cell);
  };
  const ParameterMap again = run_map(request, {}, parts);
  EXPECT_EQ(anew, std::set<std::size_t>{3});
  for (std::size_t c = 0; c < whole.cells.size(); ++c) {
    EXPECT_EQ(again.cells[c].fields.coefficients, whole.cells[c].fields.coefficients);
    EXPECT_EQ(again.cells[c].contrast, whole.cells[c].contrast);
    EXPECT_EQ(again.cells[c].outcome, whole.cells[c].outcome);
    EXPECT_EQ(again.cells[c].summary.status, whole.cells[c].summary.status);
    EXPECT_EQ(again.cells[c].summary.steps, whole.cells[c].summary.steps);
    EXPECT_EQ(again.cells[c].summary.time, whole.cells[c].summary.time);
  }
}

TEST(ParameterMap, CellsThatBlowUpAreMarkedAndTheOthersGoOn) {
  MapRequest request;
  request.model = parse_model(R"~(
name = "burst"
[species.u]
diffusion = "D"
rate = "g*u^2"
initial = "1 + 0.1*noise(2)"
[parameters]
D = 1
g = 0
[suggested]
step = 0.05
end = 20
)~",
                              "burst.toml");
  request.x = {"g", -1, 1, 2};
  request.y = {"D", 1, 2, 2};
  request.side = 10;
  const ParameterMap map = run_map(request);
  for (const MapCell& cell : map.cells) {
    EXPECT_EQ(cell.outcome, cell.x > 0 ? CellOutcome::failed : CellOutcome::uniform) << cell.x << " " << cell.y;
    EXPECT_EQ(cell.summary.message.empty(), cell.x < 0);
  }
  EXPECT_EQ(map.cells[1].x, 1);  // x runs fastest
  EXPECT_EQ(map.cells[1].y, 1);
  EXPECT_EQ(map.cells[2].y, 2);

  request.side.reset();  // neither the model nor linear theory knows a length
  EXPECT_THROW(run_map(request), Error);
  request.x.parameter = "nonsense";
  EXPECT_THROW(run_map(request), Error);
}

TEST(ParameterMap, StopsWhenAsked) {
  std::atomic<int> calls = 0;
  try {
    run_map(schnakenberg_map(), [&](std::string_view, double) { return ++calls < 5; });
    FAIL() << "the map was drawn to its end";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::cancelled);
  }
  EXPECT_EQ(calls, 5);
}

/// Of four cells one begins; one has a diffusion that is negative somewhere, two have a parameter out of range.
TEST(ParameterMap, CellsThatCannotBeginFailAlone) {
  MapRequest request;
  request.model = parse_model(R"~(
name = "half"
[species.u]
diffusion = "1 + a*x"
rate = "-u"
initial = "1 + 0.1*noise(2)"
[parameters]
a = 0
q = { value = 0, min = 0, max = 1 }
)~",
                              "half.toml");
  request.x = {"a", 0, -2, 2};
  request.y = {"q", 0, 2, 2};
  request.side = 10;
  request.until = 1;
  const ParameterMap map = run_map(request);
  ASSERT_EQ(map.cells.size(), 4u);
  EXPECT_NE(map.cells[0].outcome, CellOutcome::failed) << map.cells[0].summary.message;
  EXPECT_FALSE(map.cells[0].fields.coefficients.empty());
  const char* const message[] = {"", "negative somewhere", "parameter \"q\" is 2", "parameter \"q\" is 2"};
  for (std::size_t c = 1; c < 4; ++c) {
    EXPECT_EQ(map.cells[c].outcome, CellOutcome::failed);
    EXPECT_NE(map.cells[c].summary.message.find(message[c]), std::string::npos) << map.cells[c].summary.message;
    EXPECT_TRUE(map.cells[c].fields.coefficients.empty());
  }

  request.y = {"q", 2, 3, 2};  // out of range everywhere
  EXPECT_THROW(run_map(request), Error);
}

TEST(ParameterMap, SidesThatNoMeshFitsAreRefused) {
  MapRequest request = schnakenberg_map();
  for (const double side : {1e6, 1e12, 1e300}) {
    request.side = side;
    try {
      run_map(request);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      EXPECT_NE(std::string(error.what()).find("give a side of at most"), std::string::npos) << error.what();
    }
  }
  for (const double side : {1e-3, 1e-300}) {  // whatever comes of them
    request.side = side;
    request.until = 1;
    EXPECT_EQ(run_map(request).cells.size(), 4u);
  }
}

}  // namespace
}  // namespace pelage
