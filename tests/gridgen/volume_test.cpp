#include "gridgen/volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/regions.h"
#include "gridgen/block_functional.h"
#include "shape/vectors.h"

namespace pelage {
namespace {

/// An uneven grid without folds.
std::vector<Point> uneven(const Block& block) {
  std::vector<Point> nodes;
  for (int k = 0; k < block.count[2]; ++k)
    for (int j = 0; j < block.count[1]; ++j)
      for (int i = 0; i < block.count[0]; ++i)
        nodes.push_back({i + 0.2 * std::sin(2.0 * j + k), 0.7 * j + 0.1 * std::sin(3.0 * i),
                         1.3 * k + 0.2 * std::sin(1.0 * i * j)});
  return nodes;
}

TEST(Volume, gradient_is_that_of_differences) {
  const Block block{{4, 4, 3}};
  for (const double blunt : {0.0, 0.3})
    for (const GridWeights& weights :
         {GridWeights{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0.4, 0.3, 0.2, 0.1}}) {
      std::vector<Point> nodes = uneven(block), gradient, unused;
      const BlockFunctional functional(block, nodes, weights, blunt);
      if (blunt > 0) nodes[21][0] += 3;  // folded
      functional(nodes, gradient);
      for (const std::size_t v : {0u, 17u, 21u, 26u, 47u})
        for (std::size_t k = 0; k < 3; ++k) {
          constexpr double step = 1e-6;
          const double here = nodes[v][k];
          nodes[v][k] = here + step;
          const double above = functional(nodes, unused);
          nodes[v][k] = here - step;
          const double below = functional(nodes, unused);
          nodes[v][k] = here;
          EXPECT_NEAR((above - below) / (2 * step), gradient[v][k], 1e-6 * (1 + std::abs(gradient[v][k])));
        }
    }
}

/// What is linear along each axis alone comes back from its faces.
TEST(Volume, between_faces_trilinear_maps_are_exact) {
  const Block block{{5, 4, 6}};
  std::vector<Point> nodes, exact;
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i) {
        const double u = i / 4.0, v = j / 3.0, w = k / 5.0;
        exact.push_back({u + v * w, v - 0.5 * u * v * w, w + u * v});
        nodes.push_back(block.on_border(exact.size() - 1) ? exact.back() : Point{9, 9, 9});
      }
  fill_between_faces(block, nodes);
  for (std::size_t n = 0; n < nodes.size(); ++n) EXPECT_LT(length(difference(nodes[n], exact[n])), 1e-12);
}

const std::string cube = R"~(nodes = [7, 7, 7]
bottom = {south = {points = [[0, 0], [1, 0]]}, east = {points = [[1, 0], [1, 1]]}, north = {points = [[0, 1], [1, 1]]}, west = {points = [[0, 0], [0, 1]]}}
top = {south = {points = [[0, 0, 1], [1, 0, 1]]}, east = {points = [[1, 0, 1], [1, 1, 1]]}, north = {points = [[0, 1, 1], [1, 1, 1]]}, west = {points = [[0, 0, 1], [0, 1, 1]]}}
)~";

TEST(Volume, a_cube_has_the_even_grid) {
  const GeneratedGrid g = generate(parse_region(cube, "a.toml"));
  EXPECT_EQ(g.grid.count, (std::array<std::int32_t, 3>{7, 7, 7}));
  for (std::int32_t v = 0; v < 343; ++v)
    EXPECT_LT(length(difference(g.grid.point(v), {v % 7 / 6.0, v / 7 % 7 / 6.0, v / 49 / 6.0})), 1e-6);
}

/// Nodes that are thrown about come back.
TEST(Volume, folds_are_taken_out) {
  const Block block{{6, 6, 6}};
  std::vector<Point> nodes = uneven(block);
  for (std::size_t v = 0; v < nodes.size(); ++v)
    if (!block.on_border(v))
      nodes[v] = {2.5 + std::sin(7.0 * static_cast<double>(v)), 2 + std::cos(3.0 * static_cast<double>(v)), 3};
  EXPECT_LT(first_folded(block, nodes), block.cells());
  EXPECT_TRUE(untangle(block, nodes).unfolded);
  EXPECT_EQ(first_folded(block, nodes), block.cells());
}

TEST(Volume, pillars_may_lean_and_run_either_way) {
  const std::string bent = cube + R"~(
[pillars]
south-west = {formula = {x = "0.6 * sin(pi * t)", y = "0", z = "t"}}
south-east = {formula = {x = "1 + 0.6 * sin(pi * t)", y = "0", z = "t"}}
north-west = {formula = {x = "0.3 * sin(pi * t)", y = "1", z = "1 - t"}}
)~";
  EXPECT_EQ(generate(parse_region(bent, "a.toml")).quality.folded, 0u);
  const GeneratedGrid twist = generate(load_region("twist"));
  EXPECT_EQ(twist.quality.folded, 0u);
  EXPECT_GT(twist.quality.smallest_angle, 30);
}

std::string fault_of(const std::string& text) {
  try {
    generate(parse_region(text, "a.toml"));
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Volume, faults_carry_their_place) {
  EXPECT_EQ(fault_of("nodes = [7, 7]" + cube.substr(17)), "a.toml:1:9: nodes are [ALONG, ACROSS, UP]");
  EXPECT_EQ(fault_of(cube + "[pillars]\nsouth-east = {points = [[1, 0, 0], [1, 1, 1]]}"),
            "a.toml:5:24: the edge south-east must run from (1, 0) to (1, 0, 1), corners of bottom and top");
  EXPECT_EQ(fault_of(cube + "attract = \"1 + x\""),
            "a.toml:1:1: a volume is not periodic, attracts no nodes and lies on no surface");
  EXPECT_EQ(fault_of(cube.substr(0, cube.find("top"))), "a.toml:1:1: \"top\" is missing; add it");
}

}  // namespace
}  // namespace pelage
