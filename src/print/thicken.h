#pragma once
// Surfaces made solid.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

enum class WallSide { inward, both };

/// A surface with a wall: its vertices as they were or half a wall further out, and the same vertices on the other
/// side.
struct Wall {
  TriangleMesh mesh;               ///< closed; the first vertices are those of the surface
  std::vector<std::uint8_t> part;  ///< per triangle: 0 of the surface, 1 of its other side, 2 along its borders
  std::size_t thinner = 0;         ///< vertices where there was no room for the whole wall
  double thinnest = 0;             ///< wall anywhere [world units]
};

/// A manifold surface gets walls of that thickness (above 0): inwards, against the normals of its triangles, or half to
/// either side. Flat faces keep the distance also where they meet at an edge, unless it is sharper than 60 degrees.
/// Where the wall would meet itself it is thinner. Attributes of vertices are those of the surface on both sides, those
/// of corners and faces likewise, at borders of the triangle there; "normal" is left out.
Wall thickened(const TriangleMesh& surface, double thickness, WallSide side);

}  // namespace pelage
