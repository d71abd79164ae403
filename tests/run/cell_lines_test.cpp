#include "run/cell_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shape/cell_neighbours.h"
#include "shape/cells.h"
#include "shape/generators.h"
#include "support/soups.h"

namespace pelage {
namespace {

/// Cosine of the angle between a line and that of a neighbour, unfolded into its plane; the smallest share of pairs
/// below `limit`.
double share_of_turns(const Cells& cells, const std::vector<Point>& lines, double limit) {
  const CellNeighbours all(cells.points, cells.normals, cells.radius);
  double turned = 0, pairs = 0;
  std::vector<CellNeighbour> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    all.find(i, 0.7 * cells.radius, found);
    for (const CellNeighbour& n : found) {
      const auto j = static_cast<std::size_t>(n.cell);
      turned += std::abs(dot(lines[i], turned_into(lines[j], cells.normals[j], cells.normals[i]))) < limit;
      ++pairs;
    }
  }
  return turned / pairs;
}

/// A torus has a field without singularities, a sphere has four of half a turn.
TEST(CellLines, TheSmoothestFieldHasNoMoreSingularitiesThanItMust) {
  const Cells torus = make_cells(shared(builtin_shape("builtin:torus?n=5000")), 2000);
  EXPECT_LT(share_of_turns(torus, cell_lines(torus, {}), std::cos(0.5)), 1e-3);
  const Cells sphere = make_cells(shared(builtin_shape("builtin:sphere?n=5000")), 2000);
  const double share = share_of_turns(sphere, cell_lines(sphere, {}), std::cos(0.5));
  EXPECT_GT(share, 1e-4);
  EXPECT_LT(share, 0.02);
}

/// On a flat sheet, over its cracks, all follow the few that have a direction.
TEST(CellLines, FollowTheFewThatAreGiven) {
  const Cells cells = make_cells(shared(square_with_t_junctions()), 600);
  std::vector<Point> given(cells.nodes(), Point{});
  given[5] = {1, 2, 0.3};
  const Point line = unit({1, 2, 0});
  for (const Point& d : cell_lines(cells, given)) EXPECT_NEAR(std::abs(dot(d, line)), 1, 1e-4);
}

TEST(CellLines, WishesAreProjected) {
  const Cells cells = make_cells(shared(builtin_shape("builtin:sphere?n=5000")), 500);
  FieldWish wish;
  wish.axis = Point{0, 0, 2};
  const std::vector<Point> along = wished_on_cells(cells, wish);
  wish.across = true;
  const std::vector<Point> across = wished_on_cells(cells, wish);
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    EXPECT_NEAR(dot(along[i], cells.normals[i]), 0, 1e-12);
    EXPECT_NEAR(dot(along[i], across[i]), 0, 1e-12);
    EXPECT_NEAR(across[i][2], 0, 1e-12);
  }
  for (const Point& d : cell_lines(cells, along)) EXPECT_NEAR(length(d), 1, 1e-12);
}

}  // namespace
}  // namespace pelage
