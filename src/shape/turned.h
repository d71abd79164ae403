#pragma once
// Closed surfaces of revolution.

#include <array>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The profile's corners are radius and height, the first and the last on the axis (radius 0); corners are rounded, as
/// far as a third of the way to the next. It is turned around y into about `vertices` vertices, evenly spaced and
/// oriented outward.
TriangleMesh turned_shape(const std::vector<std::array<double, 2>>& profile, int vertices);

}  // namespace pelage
