#pragma once
// Grids: nodes in rows, sheets or blocks. Lines, tiles, images, regions with fitted boundaries, volumes.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Node (i, j, k) has the number i + count[0] * (j + count[1] * k). Nodes of a closed axis reach from border to border;
/// behind the last node of a periodic one comes the first again.
struct Grid {
  std::array<std::int32_t, 3> count{1, 1, 1};  ///< nodes along each axis; 1: no extent along it and all later ones
  std::array<bool, 3> periodic{};
  Point origin{};                 ///< of node (0, 0, 0), where positions are not given [world units]
  Point spacing{1, 1, 1};         ///< between nodes, likewise [world units]
  std::vector<Point> points;      ///< of all nodes [world units]; empty: even, along x, y and z
  std::array<Point, 3> period{};  ///< with `points`: from the first node to that behind the last one of a periodic axis
  std::vector<Attribute> attributes;  ///< per node (Domain::vertex)
  std::optional<double> metres_per_unit = {};

  /// Axes with an extent: 1, 2 or 3.
  int dimension() const { return count[2] > 1 ? 3 : count[1] > 1 ? 2 : 1; }
  std::size_t nodes() const;
  bool even() const { return points.empty(); }
  /// Between nodes along an axis.
  std::int32_t cells(int axis) const { return periodic[axis] ? count[axis] : count[axis] - 1; }
  std::int32_t node(std::int32_t i, std::int32_t j, std::int32_t k) const { return i + count[0] * (j + count[1] * k); }
  Point point(std::int32_t node) const;

  /// The attribute of that name, or nullptr.
  const Attribute* find(std::string_view name) const;
  /// Replaces an attribute of the same name.
  void set(Attribute attribute);
};

}  // namespace pelage
