#pragma once
// Edges of triangles that need not fit together.

#include <cstdint>
#include <vector>

#include "shape/topology.h"

namespace pelage {

/// Per half-edge 3*f+k, from corner k to corner k+1 of triangle f: the half-edge of the only other triangle at the same
/// two places; -1 where there is none, -2 where there are several.
std::vector<std::int32_t> soup_twins(const TriangleMesh& mesh);

/// Edges for splitting triangles at their midpoints (shape/refine.h): those of exactly two triangles at the same two
/// vertices, in opposite directions, are one; all others are of one triangle alone. Not for walks around vertices.
Topology soup_topology(std::size_t vertex_count, std::vector<Triangle> triangles);

}  // namespace pelage
