#pragma once
// Turns values per corner (uv with seams, sharp normals) into values per vertex: a vertex whose corners
// carry different values becomes several vertices at the same place.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Which vertices there are once the vertices of a mesh are split. The first `mesh.points.size()` of them
/// keep their numbers; the additional ones follow in the order in which the triangles meet them.
struct CornerSplit {
  std::vector<Triangle> triangles;   ///< the triangles of the mesh in numbers of split vertices
  std::vector<std::int32_t> vertex;  ///< per split vertex: the vertex of the mesh that it comes from
  std::vector<std::int32_t>
      corner;  ///< per split vertex: a corner 3*f+k that carries its values, -1 if no triangle has it
};

/// Splits where the values of any of the given attributes (all of Domain::corner) differ in any bit but
/// the sign of zero.
CornerSplit find_split(const TriangleMesh& mesh, const std::vector<const Attribute*>& corner_attributes);

/// The attribute per split vertex, from either domain (0 at vertices without a triangle).
Attribute split_attribute(const Attribute& attribute, const CornerSplit& split);

/// The same surface with all attributes per vertex; a mesh without corner attributes comes back unchanged.
TriangleMesh split_corners(const TriangleMesh& mesh);

}  // namespace pelage
