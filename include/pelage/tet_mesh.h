#pragma once
// Volumes as tetrahedra.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Four node numbers; (b - a) x (c - a) . (d - a) > 0.
using Tetrahedron = std::array<std::int32_t, 4>;

/// Nodes, tetrahedra between them, and named values at the nodes.
struct TetMesh {
  std::vector<Point> points;  ///< [world units]
  std::vector<Tetrahedron> tets;
  std::vector<Attribute> attributes;  ///< per node (Domain::vertex)
  std::optional<double> metres_per_unit = {};
  /// What it fills; null where it comes from a file.
  std::shared_ptr<const TriangleMesh> surface = {};

  std::size_t nodes() const { return points.size(); }
  /// The attribute of that name, or nullptr.
  const Attribute* find(std::string_view name) const;
  /// Replaces an attribute of the same name.
  void set(Attribute attribute);
};

}  // namespace pelage
