#include "gridgen/region.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gridgen/outline.h"

namespace pelage {
namespace {

std::string fault_of(const std::string& text) {
  try {
    parse_region(text, "a.toml");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Region, faults_carry_their_place) {
  EXPECT_EQ(fault_of("nodes = [3, 3]"),
            "a.toml:1:1: the side south is missing; give south, east, north and west, or one outline");
  EXPECT_EQ(fault_of("nodes = [3, 1]"), "a.toml:1:13: a grid needs 2 to 10000 nodes along each axis");
  EXPECT_EQ(fault_of("nodes = [3]"), "a.toml:1:9: nodes are [ALONG, ACROSS]");
  EXPECT_EQ(fault_of("south = {points = [[0, 0]]}"), "a.toml:1:19: a side needs at least two points");
  EXPECT_EQ(fault_of("south = {points = [[0, 0], [1]]}"), "a.toml:1:28: a point is [X, Y] or [X, Y, Z]");
  EXPECT_EQ(fault_of("south = {}"), "a.toml:1:9: a curve is given by one of \"points\", \"formula\" and \"svg\"");
  EXPECT_EQ(fault_of("south = {formula = {x = \"t\", y = \"s\"}}").substr(0, 12), "a.toml:1:35:");
  EXPECT_EQ(fault_of("south = {formula = {x = \"t\", y = \"x + noise(1)\"}}").substr(0, 12), "a.toml:1:35:");
  EXPECT_EQ(fault_of("periodic = \"y\""), "a.toml:1:12: the first axis alone can be periodic: \"x\"");
  EXPECT_EQ(fault_of("periodic = \"x\"\nwest = {points = [[0, 0], [1, 0]]}\nsouth = {points = [[0, 0], [1, 0], [1, "
                     "1]]}\nnorth = {points = [[0, 0], [1, 0], [1, 1]]}"),
            "a.toml:2:8: a ring has no side west; leave it out");
  EXPECT_EQ(fault_of("outline = {svg = {d = \"M 0 0 L 1 0 L 1 1\"}}"),
            "a.toml:1:24: the path is open; end it with Z, or where it begins");
  EXPECT_EQ(fault_of("outline = {points = [[0, 0], [1, 0], [1, 1]], corners = [0, 0.2, 0.3]}"),
            "a.toml:1:57: an outline has four corners");
  EXPECT_EQ(fault_of("outline = {points = [[0, 0], [1, 0], [1, 1]], corners = [0, 0.2, 0.3, 7]}"),
            "a.toml:1:71: a corner is a point, or a parameter of the outline from 0 to 1");
  EXPECT_EQ(fault_of("outline = {points = [[0, 0], [1, 0], [1, 1]]}\nweights = {length = -1}"),
            "a.toml:2:11: weights are numbers of at least 0, one of them greater");
  EXPECT_EQ(fault_of("outline = {points = [[0, 0], [1, 0], [1, 1]]}\nnode = [3, 3]"),
            "a.toml:2:1: unknown key \"node\"; did you mean \"nodes\"?");
}

TEST(Region, finds_the_corners_of_a_drawn_quadrilateral) {
  const std::vector<Point> drawn = {{0.5, -0.05, 0}, {1, 0, 0},      {1.2, 0.4, 0}, {1.3, 1, 0},    {0.6, 1.1, 0},
                                    {0, 1, 0},       {-0.2, 0.5, 0}, {0, 0, 0},     {0.5, -0.05, 0}};
  const Curve outline = polyline(drawn, {});
  const std::vector<Point> corners = outline.at(find_corners(outline));
  EXPECT_EQ(corners, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1.3, 1, 0}, {0, 1, 0}}));
}

TEST(Region, a_round_outline_is_cut_into_quarters) {
  const auto formula = [](const char* text) { return FormulaFunction({text, {}}, {"t"}); };
  const Curve circle = formula_curve({formula("cos(2 * pi * t)"), formula("sin(2 * pi * t)"), formula("0")}, {});
  const auto t = find_corners(circle);
  for (std::size_t k = 0; k < 4; ++k) {
    const double quarter = t[(k + 1) % 4] - t[k];
    EXPECT_NEAR(quarter - std::floor(quarter), 0.25, 1e-3);
  }
}

TEST(Region, crossings_and_insides) {
  const std::vector<Point> bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
  const auto crossing = first_crossing(bow);
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->first, 0u);
  EXPECT_EQ(crossing->second, 2u);
  EXPECT_NEAR(crossing->place[0], 1, 1e-12);
  const std::vector<Point> box = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_FALSE(first_crossing(box));
  EXPECT_EQ(doubled_area(box), 8);
  EXPECT_TRUE(contains(box, {1, 1, 0}));
  EXPECT_FALSE(contains(box, {3, 1, 0}));
}

}  // namespace
}  // namespace pelage
