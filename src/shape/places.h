#pragma once
// Vertices in exactly the same place.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// For each vertex the smallest number of a vertex with the same coordinates (0 and -0 are the same). Only
/// vertices with compared[v] != 0 and finite coordinates are compared; every other one is alone.
std::vector<std::int32_t> same_places(const std::vector<Point>& points, const std::vector<char>& compared);

}  // namespace pelage
