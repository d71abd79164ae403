#pragma once
// Turns values per corner (uv with seams, sharp normals) into values per vertex: a vertex whose corners
// carry different values becomes several vertices at the same place.

#include <cstdint>
#include <vector>

#include "pelage/polygon_mesh.h"

namespace pelage {

/// The same surface with all corner attributes per vertex; those of faces stay. The first points.size() vertices keep
/// their numbers; the additional ones follow in the order in which the faces meet them. Vertices are split where the
/// values of any corner attribute differ in any bit but the sign of zero; vertices without a face get 0. A mesh without
/// corner attributes comes back unchanged.
PolygonMesh split_corners(PolygonMesh mesh);
TriangleMesh split_corners(const TriangleMesh& mesh);

}  // namespace pelage
