#include "gridgen/block.h"

#include "shape/vectors.h"

namespace pelage {

std::size_t Block::node(std::int32_t i, std::int32_t j, std::int32_t k) const {
  const auto [n, m, unused] = count;
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(n) *
             (static_cast<std::size_t>(j) + static_cast<std::size_t>(m) * static_cast<std::size_t>(k));
}

std::size_t Block::cells() const { return Block{{count[0] - 1, count[1] - 1, count[2] - 1}}.nodes(); }

std::array<std::size_t, 8> Block::corners(std::size_t cell) const {
  const auto n = static_cast<std::size_t>(count[0] - 1), m = static_cast<std::size_t>(count[1] - 1);
  const auto i = static_cast<std::int32_t>(cell % n), j = static_cast<std::int32_t>(cell / n % m),
             k = static_cast<std::int32_t>(cell / n / m);
  std::array<std::size_t, 8> result{};
  for (std::int32_t corner = 0; corner < 8; ++corner)
    result[static_cast<std::size_t>(corner)] = node(i + corner % 2, j + corner / 2 % 2, k + corner / 4);
  return result;
}

bool Block::on_border(std::size_t number) const {
  std::size_t rest = number;
  for (const std::int32_t n : count) {
    const auto i = static_cast<std::int32_t>(rest % static_cast<std::size_t>(n));
    if (i == 0 || i == n - 1) return true;
    rest /= static_cast<std::size_t>(n);
  }
  return false;
}

BlockCorner block_corner(const std::array<Point, 8>& x, std::size_t corner) {
  BlockCorner result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t bit = std::size_t{1} << axis;
    result.edge[axis] = difference(x[corner | bit], x[corner & ~bit]);
  }
  result.volume = dot(result.edge[0], cross(result.edge[1], result.edge[2]));
  return result;
}

std::size_t first_folded(const Block& block, const std::vector<Point>& nodes) {
  for (std::size_t c = 0; c < block.cells(); ++c) {
    std::array<Point, 8> x;
    const auto v = block.corners(c);
    for (std::size_t k = 0; k < 8; ++k) x[k] = nodes[v[k]];
    for (std::size_t k = 0; k < 8; ++k)
      if (!(block_corner(x, k).volume > 0)) return c;
  }
  return block.cells();
}

}  // namespace pelage
