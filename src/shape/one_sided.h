#pragma once
// Surfaces with one side only, for all that looks at one side at a time.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Cuts triangles apart along edges that two of them pass in the same direction: what is left has two sides. The first
/// `vertices` vertices keep their numbers, further ones follow. Returns of each vertex the number that it had.
std::vector<std::int32_t> cut_between_sides(std::vector<Triangle>& triangles, std::size_t vertices);

}  // namespace pelage
