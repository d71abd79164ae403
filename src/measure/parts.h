#pragma once
// Connected parts of a surface where a function is above a level, or below it.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

struct PartNumbers {
  std::size_t count = 0;
  std::vector<std::int32_t> of;  ///< per vertex, -1 elsewhere and for vertices without triangles
};

/// Of a function that is linear on the triangles: they are those of its vertices.
PartNumbers connected_parts(const std::vector<Triangle>& triangles, const std::vector<double>& values, double level,
                            bool above);

}  // namespace pelage
