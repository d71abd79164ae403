#pragma once
// Tangents of texture space, as normal maps are read with (the convention MikkTSpace: Mikkelsen 2008, "Simulation of
// wrinkled surfaces revisited", and glTF 2.0).

#include "pelage/triangle_mesh.h"

namespace pelage {

/// "tangent", four components at the corners: the unit direction in which u grows, perpendicular to the normal, and the
/// side of v, +1 or -1: bitangent = side * cross(normal, tangent), v upwards. Corners at one vertex that have the same
/// normal and uv share a tangent where their triangles meet in edges and lie in the image the same way round: the mean
/// of those of the triangles, weighted by their angles. Of triangles without area in the image it is that of the
/// neighbours or, where these have none, any.
/// `mesh` has "normal" (3) and "uv" (2), at vertices or corners.
Attribute corner_tangents(const TriangleMesh& mesh);

}  // namespace pelage
