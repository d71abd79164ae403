#include "gridgen/generate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/parallel.h"
#include "base/srgb.h"
#include "catalog/regions.h"
#include "gridgen/free_nodes.h"
#include "gridgen/functional.h"
#include "gridgen/transfinite.h"
#include "gridgen/untangle.h"
#include "io/grid_file.h"
#include "shape/grid.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

GeneratedGrid made(const std::string& text, std::int32_t n, std::int32_t m) {
  return generate(parse_region(text, "a.toml"), {.nodes = std::array{n, m}});
}

std::string fault_of(const std::string& text) {
  try {
    generate(parse_region(text, "a.toml"));
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const std::string square = R"~(
south = {points = [[0, 0], [1, 0]]}
east = {points = [[1, 0], [1, 1]]}
north = {points = [[0, 1], [1, 1]]}
west = {points = [[0, 0], [0, 1]]}
)~";

/// The text with one piece replaced.
std::string with(std::string text, const std::string& piece, const std::string& other) {
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return text.replace(at, piece.size(), other);
}

/// Smallest angles that the shipped regions reach at the least, at 20 x 20 and at 60 x 60 nodes.
TEST(Generate, no_shipped_region_folds) {
  ASSERT_GE(region_names().size(), 9u);
  for (const std::string& name : region_names())
    for (const std::int32_t n : {20, 60}) {
      if (n > 20 && load_region(name).volume) continue;  // 90,000 nodes
      const GeneratedGrid g = generate(load_region(name), {.nodes = std::array{n, n}});
      EXPECT_NO_THROW(require_sound(g.grid));
      EXPECT_EQ(g.quality.folded, 0u) << name;
      EXPECT_GT(g.quality.smallest_area, 0) << name;
      EXPECT_GT(g.quality.smallest_angle, 5) << name << " at " << n;
      EXPECT_TRUE(g.converged) << name;
      RecordProperty(name + "_" + std::to_string(n), std::to_string(g.quality.smallest_angle));
    }
}

TEST(Generate, a_square_has_the_even_grid_from_any_start) {
  const Sheet sheet{{21, 21}, false};
  std::vector<Point> even, nodes;
  for (int j = 0; j < 21; ++j)
    for (int i = 0; i < 21; ++i) even.push_back({i / 20.0, j / 20.0, 0});
  nodes = even;
  for (std::size_t v = 0; v < nodes.size(); ++v)
    if (!sheet.on_border(v))
      nodes[v] = {even[v][0] + 0.1 * even[v][1] * std::sin(M_PI * even[v][0]), even[v][1] * even[v][1], 0};
  minimise_inner(sheet, nodes, SheetFunctional(sheet, nodes, {}, nullptr, nullptr), {.tolerance = 1e-13});
  for (std::size_t v = 0; v < nodes.size(); ++v) EXPECT_LT(length(difference(nodes[v], even[v])), 1e-5);
  const GeneratedGrid g = made(square, 21, 21);
  for (std::size_t v = 0; v < nodes.size(); ++v) EXPECT_LT(length(difference(g.grid.points[v], even[v])), 1e-9);
  EXPECT_NEAR(g.quality.smallest_angle, 90, 1e-6);
}

TEST(Generate, the_minimum_is_below_the_start_and_stays_under_small_moves) {
  const Region region = load_region("dome");
  const GeneratedGrid g = generate(region, {.nodes = std::array{15, 15}});
  const Sheet sheet{{15, 15}, false};
  const SheetFunctional functional(sheet, g.grid.points, region.weights, nullptr, nullptr);
  std::vector<Point> unused, moved;
  const double least = functional(g.grid.points, unused);
  EXPECT_NEAR(least, g.functional, 1e-3 * least);
  for (const std::size_t v : {sheet.node(3, 4), sheet.node(7, 7), sheet.node(12, 13)})
    for (std::size_t k = 0; k < 2; ++k)
      for (const double step : {-0.01, 0.01}) {
        moved = g.grid.points;
        moved[v][k] += step;
        EXPECT_GT(functional(moved, unused), least);
      }
}

TEST(Generate, a_folded_start_is_unfolded) {
  const GeneratedGrid swan = generate(load_region("swan"));
  EXPECT_GT(swan.folded_start, 0.02);
  EXPECT_EQ(swan.quality.folded, 0u);
  // A horseshoe whose arms reach round to each other: transfinite interpolation leaves it by far.
  const std::string bent = R"~(
    south = {formula = {x = "2 * cos(5.6 * t)", y = "2 * sin(5.6 * t)"}}
    north = {formula = {x = "0.5 * cos(5.6 * t)", y = "0.3 * sin(5.6 * t)"}}
    west = {points = [[2, 0], [0.5, 0]]}
    east = {formula = {x = "(2 - 1.5 * t) * cos(5.6)", y = "(2 - 1.7 * t) * sin(5.6)"}}
  )~";
  EXPECT_EQ(made(bent, 60, 20).quality.folded, 0u);
}

/// Nodes that are thrown far over the border come back.
TEST(Generate, untangling_brings_back_nodes_from_anywhere) {
  const Sheet sheet{{12, 12}, false};
  std::vector<Point> nodes;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) {
      nodes.push_back({i / 11.0, j / 11.0, 0});
      if (!sheet.on_border(nodes.size() - 1)) nodes.back() = {std::sin(7.0 * i + j), std::cos(3.0 * j - i), 0};
    }
  ASSERT_LT(first_folded(sheet, nodes), sheet.cells());
  EXPECT_TRUE(untangle(sheet, nodes).unfolded);
  EXPECT_EQ(first_folded(sheet, nodes), sheet.cells());
}

/// Of a square of 41 x 41 nodes whose middle attracts them nine times as much as its corners.
void expect_dense_middle(const GeneratedGrid& g) {
  const auto area_at = [&](std::int32_t i, std::int32_t j) {
    const auto& p = g.grid.points;
    const auto at = [&](std::int32_t a, std::int32_t b) { return p[static_cast<std::size_t>(g.grid.node(a, b, 0))]; };
    return plane_cross(difference(at(i + 1, j + 1), at(i, j)), difference(at(i, j + 1), at(i + 1, j))) / 2;
  };
  const double middle = area_at(20, 20), corner = area_at(1, 1);
  EXPECT_LT(middle, corner / 3) << "the density is nine times as high";
  EXPECT_GT(middle, corner / 12);
  EXPECT_EQ(g.quality.folded, 0u);
}

TEST(Generate, attraction_gives_nodes_in_proportion) {
  expect_dense_middle(
      made("attract = \"if(x < 0.5, 1, 1) + 8 * exp(-30 * ((x - 0.5)^2 + (y - 0.5)^2))\"" + square, 41, 41));
}

double hill(double x, double y) { return std::exp(-30 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5))); }

/// What a run left on a grid of the region, even or bent, or what an image shows.
TEST(Generate, a_field_in_a_file_attracts_as_a_formula_does) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "pelage_generate_test";
  std::filesystem::create_directories(folder);
  Grid bent;
  bent.count = {31, 31, 1};
  Attribute b{"b", 1, Domain::vertex, {}};
  for (int j = 0; j < 31; ++j)
    for (int i = 0; i < 31; ++i) {
      const double s = i / 30.0, t = j / 30.0, wave = 0.03 * std::sin(2 * M_PI * s) * std::sin(2 * M_PI * t);
      bent.points.push_back({s + wave, t - wave, 0});
      b.values.push_back(hill(s + wave, t - wave));
    }
  bent.set(b);
  write_grid(bent, (folder / "bent.vts").string());
  Grid image;
  image.count = {64, 64, 1};
  Attribute color{"color", 3, Domain::vertex, {}};
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i)
      for (int k = 0; k < 3; ++k) color.values.push_back(linear_from_srgb(hill(i / 63.0, j / 63.0)));
  image.set(color);
  write_grid(image, (folder / "hill.png").string());
  const auto grown = [&](const std::string& field) {
    return generate(parse_region(field + square, (folder / "a.toml").string()), {.nodes = std::array{41, 41}});
  };
  const GeneratedGrid adapted = grown("attract = \"1 + 8*attribute(b)\"\nfield = \"bent.vts\"\n");
  expect_dense_middle(adapted);
  expect_dense_middle(
      grown("attract = \"1 + 8*attribute(color)\"\nfield = {file = \"hill.png\", box = [[0, 0], [1, 1]]}\n"));
  const GeneratedGrid by_formula = made("attract = \"1 + 8*exp(-30*((x - 0.5)^2 + (y - 0.5)^2))\"" + square, 41, 41);
  for (std::size_t v = 0; v < adapted.grid.points.size(); ++v)
    EXPECT_LT(length(difference(adapted.grid.points[v], by_formula.grid.points[v])), 5e-3) << v;
}

TEST(Generate, attraction_spreads_nodes_along_sides) {
  const GeneratedGrid g = made("attract = \"1 / (0.2 + x)^2\"" + square, 21, 21);
  // Nodes per length go like 1 / (0.2 + x): node i lies where the integral is i / 20 of the whole.
  for (std::int32_t i = 0; i < 21; ++i)
    EXPECT_NEAR(g.grid.points[static_cast<std::size_t>(i)][0], 0.2 * std::pow(6, i / 20.0) - 0.2, 1e-3);
}

TEST(Generate, a_ring_closes) {
  const GeneratedGrid g = generate(load_region("ring"));
  EXPECT_TRUE(g.grid.periodic[0]);
  EXPECT_EQ(g.grid.period[0], Point{});
  const TriangleMesh mesh = mesh_of(g.grid);
  EXPECT_EQ(mesh.triangles.size(), 2u * 96 * 24);
  double area = 0;
  for (const Triangle& t : mesh.triangles)
    area += plane_cross(difference(mesh.points[t[1]], mesh.points[t[0]]),
                        difference(mesh.points[t[2]], mesh.points[t[0]])) /
            2;
  EXPECT_NEAR(area, M_PI * (1 - 0.35 * 0.35), 0.01);
}

/// Between circles of one centre all lines are circles and rays, wherever the sides begin and however they run.
TEST(Generate, a_round_ring_has_rays) {
  const GeneratedGrid g = made(R"~(
    periodic = "x"
    south = {formula = {x = "0.5 * cos(2 * pi * t)", y = "0.5 * sin(2 * pi * t)"}}
    north = {formula = {x = "cos(2.3 - 2 * pi * t)", y = "sin(2.3 - 2 * pi * t)"}}
  )~",
                               36, 9);
  EXPECT_EQ(g.quality.folded, 0u);
  EXPECT_LT(g.quality.skew, 5.1) << "the angles between chords and rays differ from 90 degrees by half of 10";
  for (std::int32_t j = 0; j < 9; ++j)
    for (std::int32_t i = 0; i < 36; ++i) {
      const Point& p = g.grid.points[static_cast<std::size_t>(g.grid.node(i, j, 0))];
      const Point& q = g.grid.points[static_cast<std::size_t>(g.grid.node(0, j, 0))];
      EXPECT_NEAR(length(p), length(q), 1e-3);
    }
}

/// A cylinder unrolled: the surface's lengths are those of the plane, so the grid is the plane's one.
TEST(Generate, on_a_surface_that_can_be_unrolled_the_grid_is_that_of_the_plane) {
  const std::string trapezoid = R"~(
    south = {points = [[0, 0], [2, 0]]}
    east = {points = [[2, 0], [1.5, 1]]}
    north = {points = [[0.5, 1], [1.5, 1]]}
    west = {points = [[0, 0], [0.5, 1]]}
  )~";
  const GeneratedGrid flat = made(trapezoid, 41, 31);
  const GeneratedGrid bent =
      made(trapezoid + "surface = {x = \"2 * sin(u / 2)\", y = \"v\", z = \"2 * cos(u / 2)\"}", 41, 31);
  for (std::size_t v = 0; v < flat.grid.points.size(); ++v) {
    const Point &p = flat.grid.points[v], &q = bent.grid.points[v];
    EXPECT_NEAR(2 * std::atan2(q[0], q[2]), p[0], 0.01);
    EXPECT_NEAR(q[1], p[1], 0.01);
    EXPECT_NEAR(std::hypot(q[0], q[2]), 2, 1e-12) << "nodes stay on the surface";
  }
}

/// The parameters of a surface do not matter: the same part of the plane, given unevenly.
TEST(Generate, on_a_surface_its_parameters_do_not_matter) {
  const GeneratedGrid even = made(square, 21, 21);
  const GeneratedGrid uneven = made(square + "surface = {x = \"(u + 2 * u^2) / 3\", y = \"v\"}", 21, 21);
  for (std::size_t v = 0; v < even.grid.points.size(); ++v)
    EXPECT_LT(length(difference(even.grid.points[v], uneven.grid.points[v])), 2e-3);
}

/// Between four curves in space lies a surface; of a flat border it is the plane, in any parameters.
TEST(Generate, between_curves_in_space_lies_a_surface) {
  const std::string lifted =
      with(with(square, "[[1, 0], [1, 1]]", "[[1, 0, 1], [1, 1, 1]]"), "[[0, 1], [1, 1]]", "[[0, 1, 0], [1, 1, 1]]");
  const GeneratedGrid slope = made(with(lifted, "[[0, 0], [1, 0]]", "[[0, 0, 0], [0.3, 0, 0.3], [1, 0, 1]]"), 11, 7);
  for (std::size_t v = 0; v < slope.grid.points.size(); ++v)
    EXPECT_NEAR(slope.grid.points[v][2], slope.grid.points[v][0], 1e-9) << "on the plane z = x";
  const GeneratedGrid saddle = generate(load_region("saddle"));
  EXPECT_EQ(saddle.quality.folded, 0u);
  EXPECT_GT(saddle.quality.smallest_angle, 40);
  EXPECT_NEAR(saddle.grid.points[20][2], 0.6, 1e-6) << "south's nodes lie on south";
}

TEST(Generate, has_the_same_bits_for_any_number_of_threads) {
  const Region region = load_region("swan");
  const ThreadLimit one(1);
  const std::vector<Point> alone = generate(region).grid.points;
  const ThreadLimit four(4);
  EXPECT_EQ(generate(region).grid.points, alone);
}

TEST(Generate, sides_may_run_either_way_and_round) {
  const std::vector<Point> plain = made(square, 9, 9).grid.points;
  EXPECT_EQ(made(with(square, "[[1, 0], [1, 1]]", "[[1, 1], [1, 0]]"), 9, 9).grid.points, plain);
  const std::string clockwise = with(with(square, "east", "other"), "west", "east");
  const GeneratedGrid turned = made(with(clockwise, "other", "west"), 9, 9);
  ASSERT_EQ(turned.findings.size(), 1u);
  EXPECT_EQ(turned.findings[0].kind, "clockwise-border");
  EXPECT_EQ(turned.quality.folded, 0u);
}

TEST(Generate, an_outline_is_cut_at_its_corners) {
  const std::string outline = "outline = {points = [[0.3, 0], [1, 0], [1, 0.6], [0, 0.6], [0, 0]]}";
  const std::vector<Point> points = made(outline, 11, 7).grid.points;
  for (std::size_t v = 0; v < points.size(); ++v)
    EXPECT_LT(length(difference(points[v], {0.1 * static_cast<double>(v % 11), 0.1 * static_cast<double>(v / 11), 0})),
              1e-6);
  const std::string given =
      "outline = {points = [[0, 0], [0, 1], [1, 1], [1, 0]], corners = [[1, 0], [1, 1], [0, 1], [0, 0]]}";
  const GeneratedGrid g = made(given, 5, 5);
  EXPECT_LT(length(difference(g.grid.points[0], {1, 0, 0})), 1e-9) << "south begins in the first corner";
  EXPECT_EQ(g.findings.size(), 1u) << "the outline went round clockwise";
}

TEST(Generate, faults_of_the_border_carry_their_place) {
  EXPECT_EQ(
      fault_of(with(square, "[[1, 0], [1, 1]]", "[[1.1, 0], [1, 1]]")),
      "a.toml:3:18: the side east does not meet the side south: (1.1, 0) is not (1, 0); let both end in one corner");
  EXPECT_EQ(fault_of(with(square, "[[0, 1], [1, 1]]", "[[0, 1], [0.6, -0.5], [1, 1]]")),
            "a.toml:4:19: the side north cuts the side south at (0.733333, 0); a border may not cross itself");
  EXPECT_EQ(fault_of(with(square, "[[0, 0], [0, 1]]", "[[0, 0], [0, 0]]")),
            "a.toml:5:18: the side west has no length; give it points that differ");
  EXPECT_EQ(fault_of("outline = {formula = {x = \"cos(6 * t)\", y = \"sin(6 * t)\"}}"),
            "a.toml:1:22: the outline is open: it begins at (1, 0) and ends at (0.96017, -0.279415)");
  EXPECT_EQ(fault_of("outline = {points = [[0, 0], [1, 1], [1, 0], [0, 1]]}"),
            "a.toml:1:21: the outline cuts itself at (0.5, 0.5)");
  EXPECT_EQ(fault_of("periodic = \"x\"\nsouth = {formula = {x = \"cos(6 * t)\", y = \"sin(6 * t)\"}}\n"
                     "north = {formula = {x = \"2 * cos(2 * pi * t)\", y = \"2 * sin(2 * pi * t)\"}}"),
            "a.toml:2:20: the side south of a ring is open: it begins at (1, 0) and ends at (0.96017, -0.279415)");
  EXPECT_EQ(fault_of("periodic = \"x\"\nsouth = {formula = {x = \"cos(2 * pi * t)\", y = \"sin(2 * pi * t)\"}}\n"
                     "north = {formula = {x = \"3 + cos(2 * pi * t)\", y = \"sin(2 * pi * t)\"}}"),
            "a.toml:3:20: one of the closed sides south and north must lie within the other");
  EXPECT_EQ(fault_of("outline = {points = [[0, 0, 1], [1, 0], [1, 1]]}"),
            "a.toml:1:21: an outline lies in the plane; leave out z, and give a surface of u and v");
  EXPECT_EQ(fault_of(with(square, "[[0, 0], [1, 0]]", "[[0, 0], [0.5, 0, 1], [1, 0]]") +
                     "surface = {x = \"u\", y = \"v\", z = \"u * v\"}"),
            "a.toml:1:1: on a surface the border is given by u and v alone; leave out z");
  EXPECT_EQ(fault_of("attract = \"x - 0.5\"" + square),
            "a.toml:1:12: the attraction must be a positive number everywhere; at (0, 0) it is -0.5");
  EXPECT_NE(fault_of("attract = \"1\"\nfield = \"none.vts\"" + square).find("none.vts"), std::string::npos);
  EXPECT_EQ(fault_of("field = \"none.vts\"" + square),
            "a.toml:1:9: a field is what attract reads; give that formula, too");
}

/// South reaches into a bay of west, which two nodes cut off.
TEST(Generate, too_few_nodes_are_refused_with_the_place) {
  const std::string bay = R"~(nodes = [21, 2]
    south = {points = [[0, 0], [-0.5, 0.4], [1, 0.3]]}
    east = {points = [[1, 0.3], [1, 1]]}
    north = {points = [[0, 1], [1, 1]]}
    west = {formula = {x = "-sin(pi * t)", y = "t"}}
  )~";
  EXPECT_EQ(fault_of(bay), "a.toml:1:9: 21 x 2 nodes cut across the border near (0, 0.366667); take more");
  EXPECT_EQ(fault_of(with(bay, "[21, 2]", "[21, 21]")), "");
}

}  // namespace
}  // namespace pelage
