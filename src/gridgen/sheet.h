#pragma once
// The nodes and cells of a grid of two dimensions.

#include <array>
#include <cstdint>
#include <vector>

#include "pelage/point.h"

namespace pelage {

/// Node (i, j) has the number i + count[0] * j; cell (i, j) has it as its first corner, and its others follow
/// anticlockwise. Behind the last node of a ring's first axis comes the first one again.
struct Sheet {
  std::array<std::int32_t, 2> count{2, 2};
  bool ring = false;

  std::size_t nodes() const { return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]); }
  std::int32_t columns() const { return ring ? count[0] : count[0] - 1; }
  std::size_t cells() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(count[1] - 1); }
  std::size_t node(std::int32_t i, std::int32_t j) const {
    return static_cast<std::size_t>(i) + static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(j);
  }
  std::array<std::size_t, 4> corners(std::size_t cell) const {
    const auto i = static_cast<std::int32_t>(cell % static_cast<std::size_t>(columns()));
    const auto j = static_cast<std::int32_t>(cell / static_cast<std::size_t>(columns()));
    const std::int32_t right = i + 1 == count[0] ? 0 : i + 1;
    return {node(i, j), node(right, j), node(right, j + 1), node(i, j + 1)};
  }
  bool on_border(std::size_t number) const {
    const auto i = static_cast<std::int32_t>(number % static_cast<std::size_t>(count[0]));
    const auto j = static_cast<std::int32_t>(number / static_cast<std::size_t>(count[0]));
    return j == 0 || j == count[1] - 1 || (!ring && (i == 0 || i == count[0] - 1));
  }
};

/// The edges of a cell, along the first axis (south, north) and along the second one (west, east), and its four corners
/// as pairs of them, in the order of Sheet::corners.
struct CellEdges {
  Point south, east, north, west;
  explicit CellEdges(const std::array<Point, 4>& x);
  struct Corner {
    const Point &along, &across;
  };
  std::array<Corner, 4> corners() const { return {{{south, west}, {south, east}, {north, east}, {north, west}}}; }
};

/// Twice the signed area of the triangle in a corner, in the plane: positive where the cell is not folded there.
inline double plane_cross(const Point& along, const Point& across) {
  return along[0] * across[1] - along[1] * across[0];
}

/// The mean lengths of the border's edges along both axes; across a ring, of the straight ways between its sides. They
/// do not depend on where the inner nodes are.
std::array<double, 2> mean_edges(const Sheet& sheet, const std::vector<Point>& nodes);

/// The number of the first cell with a corner that is folded or flat in the plane, or that of all cells.
std::size_t first_folded(const Sheet& sheet, const std::vector<Point>& nodes);

}  // namespace pelage
