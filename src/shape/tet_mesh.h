#pragma once
// Volumes as meshes.

#include "pelage/tet_mesh.h"

namespace pelage {

/// The nodes as vertices with their attributes, and the triangles of the skin, counter-clockwise from outside.
TriangleMesh mesh_of(const TetMesh& volume);

/// The mean length of the edges of all tetrahedra [world units].
double mean_edge(const TetMesh& volume);

}  // namespace pelage
