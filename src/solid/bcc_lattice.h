#pragma once
// The body-centred cubic lattice: corners of cubes and their middles, between which congruent tetrahedra fill all space
// (two opposite edges along axes, "long", the other four from corner to middle, "short").

#include <array>
#include <cstdint>

#include "pelage/point.h"

namespace pelage {

/// Nodes 0 .. nodes() - 1: first all corners (i, j, k), then the middles behind them, i the fastest.
struct BccLattice {
  /// What runs through a node in seven directions: along x, y and z, and four diagonals upwards, along which corners
  /// and middles take turns.
  static constexpr int directions = 7;
  static constexpr bool is_long(int direction) { return direction < 3; }
  /// Of the tetrahedra in one cube.
  static constexpr int tets_per_cube = 12;

  std::array<std::int64_t, 3> count{};  ///< of corners, and of middles, along each axis
  Point origin{};                       ///< of corner (0, 0, 0)
  double edge = 1;                      ///< the long one

  /// Around a box, the shape well inside.
  static BccLattice around(const Point& low, const Point& high, double edge);

  std::int64_t corners() const { return count[0] * count[1] * count[2]; }
  std::int64_t nodes() const { return 2 * corners(); }
  std::int64_t node(bool middle, std::int64_t i, std::int64_t j, std::int64_t k) const {
    return (middle ? corners() : 0) + i + count[0] * (j + count[1] * k);
  }
  bool is_middle(std::int64_t node) const { return node >= corners(); }
  std::array<std::int64_t, 3> index(std::int64_t node) const {
    if (is_middle(node)) node -= corners();
    return {node % count[0], node / count[0] % count[1], node / count[0] / count[1]};
  }
  /// Whether the sum of its indices is even; the ends of a long edge differ.
  bool is_even(std::int64_t node) const {
    const auto [i, j, k] = index(node);
    return (i + j + k) % 2 == 0;
  }
  Point point(std::int64_t node) const;
  /// In edges from the origin.
  Point coordinates(const Point& p) const;
  /// The next node in a direction, or -1 where the lattice ends.
  std::int64_t next(std::int64_t node, int direction) const;
  /// The same the other way.
  std::int64_t previous(std::int64_t node, int direction) const;

  /// The direction of the edge between two nodes of one tetrahedron and its lower end: its number is
  /// directions * lower + direction.
  std::int64_t edge_between(std::int64_t a, std::int64_t b) const;

  /// Tetrahedron `number` (0 .. 11) at a corner: the ends of a long edge of corners, and then two middles beside it;
  /// false where it would leave the lattice.
  bool tetrahedron(std::int64_t corner, int number, std::array<std::int64_t, 4>& nodes) const;

  /// From a corner to the middle above it, in cubes, by diagonal: (0, 0) for (+, +), (-1, 0) for (-, +), ...
  static constexpr std::array<std::array<int, 2>, 4> diagonals = {{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

 private:
  std::int64_t moved(std::int64_t node, int direction, int by) const;
};

}  // namespace pelage
