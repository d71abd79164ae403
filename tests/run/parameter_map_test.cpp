#include "run/parameter_map.h"

#include <gtest/gtest.h>

#include <atomic>

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

}  // namespace
}  // namespace pelage
