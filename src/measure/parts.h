#pragma once
// Connected parts of a shape where a function is above a level, or below it.

#include <cstdint>
#include <vector>

#include "linalg/sparse.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

struct PartNumbers {
  std::size_t count = 0;
  std::vector<std::int32_t> of;  ///< per vertex, -1 elsewhere and for vertices without triangles
};

/// Of a function that is linear on the triangles: they are those of its vertices.
PartNumbers connected_parts(const std::vector<Triangle>& triangles, const std::vector<double>& values, double level,
                            bool above);

/// Of nodes of which those in a row of a symmetric pattern are neighbours.
PartNumbers connected_nodes(const SparsePattern& joined, const std::vector<double>& values, double level, bool above);

}  // namespace pelage
