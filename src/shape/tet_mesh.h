#pragma once
// Volumes as meshes.

#include "pelage/tet_mesh.h"

namespace pelage {

/// The side opposite to each corner of a tetrahedron, counter-clockwise from outside.
inline constexpr std::array<std::array<std::size_t, 3>, 4> tet_sides = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The nodes as vertices with their attributes, and the triangles of the skin, counter-clockwise from outside.
TriangleMesh mesh_of(const TetMesh& volume);

/// The skin alone, with the nodes that it uses in their order.
TriangleMesh skin_mesh(const TetMesh& volume);

/// Per tetrahedron, bit k: whether the side opposite to corner k is one of the skin.
std::vector<std::uint8_t> skin_sides(const TetMesh& volume);

/// The mean length of the edges of all tetrahedra [world units].
double mean_edge(const TetMesh& volume);

}  // namespace pelage
