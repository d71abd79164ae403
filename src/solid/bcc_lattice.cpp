#include "solid/bcc_lattice.h"

#include <cmath>

namespace pelage {

namespace {

/// Beyond the box; the odd fractions keep planes of the lattice off those of boxes and other regular shapes.
constexpr Point margin = {1.2137, 1.2871, 1.1619};

}  // namespace

BccLattice BccLattice::around(const Point& low, const Point& high, double edge) {
  BccLattice lattice;
  lattice.edge = edge;
  for (std::size_t d = 0; d < 3; ++d) {
    lattice.origin[d] = low[d] - margin[d] * edge;
    lattice.count[d] = static_cast<std::int64_t>(std::ceil((high[d] - lattice.origin[d]) / edge + 1.5)) + 1;
  }
  return lattice;
}

Point BccLattice::point(std::int64_t node) const {
  const auto at = index(node);
  const double half = is_middle(node) ? 0.5 : 0;
  Point p;
  for (std::size_t d = 0; d < 3; ++d) p[d] = origin[d] + edge * (static_cast<double>(at[d]) + half);
  return p;
}

Point BccLattice::coordinates(const Point& p) const {
  return {(p[0] - origin[0]) / edge, (p[1] - origin[1]) / edge, (p[2] - origin[2]) / edge};
}

/// One step on (by = 1) or back (by = -1).
std::int64_t BccLattice::moved(std::int64_t n, int direction, int by) const {
  auto at = index(n);
  bool middle = is_middle(n);
  if (is_long(direction)) {
    at[static_cast<std::size_t>(direction)] += by;
  } else {
    // From a corner half a cube in each direction: to the middle with the same index, or the one before.
    const auto& [dx, dy] = diagonals[static_cast<std::size_t>(direction - 3)];
    const auto half_step = [middle](int sign) { return middle ? (sign > 0 ? 1 : 0) : (sign > 0 ? 0 : -1); };
    at[0] += half_step(dx * by);
    at[1] += half_step(dy * by);
    at[2] += half_step(by);
    middle = !middle;
  }
  for (std::size_t d = 0; d < 3; ++d)
    if (at[d] < 0 || at[d] >= count[d]) return -1;
  return node(middle, at[0], at[1], at[2]);
}

std::int64_t BccLattice::next(std::int64_t n, int direction) const { return moved(n, direction, 1); }
std::int64_t BccLattice::previous(std::int64_t n, int direction) const { return moved(n, direction, -1); }

std::int64_t BccLattice::edge_between(std::int64_t a, std::int64_t b) const {
  const auto from = index(a), to = index(b);
  if (is_middle(a) == is_middle(b)) {
    const std::size_t d = from[0] != to[0] ? 0 : from[1] != to[1] ? 1 : 2;
    return directions * (from[d] < to[d] ? a : b) + static_cast<int>(d);
  }
  if (is_middle(a)) return edge_between(b, a);
  // A middle lies above corners of its own index along z, and below those of the next.
  const bool up = to[2] == from[2];
  const bool right = (to[0] == from[0]) == up, behind = (to[1] == from[1]) == up;
  return directions * (up ? a : b) + 3 + (right ? 0 : 1) + (behind ? 0 : 2);
}

bool BccLattice::tetrahedron(std::int64_t corner, int number, std::array<std::int64_t, 4>& nodes) const {
  const auto at = index(corner);
  const auto axis = static_cast<std::size_t>(number / 4), second = (axis + 1) % 3, third = (axis + 2) % 3;
  if (at[axis] + 1 >= count[axis] || at[second] < 1 || at[third] < 1) return false;
  auto end = at;
  ++end[axis];
  // Around the edge, counter-clockwise along its axis.
  constexpr std::array<std::array<int, 2>, 5> ring = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}, {0, 0}}};
  const auto middle = [&](int turn) {
    auto m = at;
    m[second] += ring[static_cast<std::size_t>(turn)][0];
    m[third] += ring[static_cast<std::size_t>(turn)][1];
    return node(true, m[0], m[1], m[2]);
  };
  nodes = {corner, node(false, end[0], end[1], end[2]), middle(number % 4), middle(number % 4 + 1)};
  return true;
}

}  // namespace pelage
