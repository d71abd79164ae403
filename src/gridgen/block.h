#pragma once
// The nodes and cells of a grid of three dimensions.

#include <array>
#include <cstdint>
#include <vector>

#include "pelage/point.h"

namespace pelage {

/// Node (i, j, k) has the number i + count[0] * (j + count[1] * k); corner number a + 2 b + 4 c of cell (i, j, k) is
/// node (i + a, j + b, k + c).
struct Block {
  std::array<std::int32_t, 3> count{2, 2, 2};

  std::size_t node(std::int32_t i, std::int32_t j, std::int32_t k) const;
  std::size_t nodes() const { return node(count[0] - 1, count[1] - 1, count[2] - 1) + 1; }
  std::size_t cells() const;
  std::array<std::size_t, 8> corners(std::size_t cell) const;
  bool on_border(std::size_t number) const;
};

/// The edges that leave a corner of a cell along the three axes, each in the direction of its axis.
struct BlockCorner {
  std::array<Point, 3> edge;
  double volume = 0;  ///< of the parallelepiped, positive where the cell is not folded there
};

/// Corner number a + 2 b + 4 c of a cell with these corner points.
BlockCorner block_corner(const std::array<Point, 8>& x, std::size_t corner);

/// The number of the first cell with a corner that is folded or flat, or that of all cells.
std::size_t first_folded(const Block& block, const std::vector<Point>& nodes);

}  // namespace pelage
