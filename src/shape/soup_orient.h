#pragma once
// One side for polygons that do not fit together.

#include <cstddef>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Reverses triangles so that those that meet agree which side is outside: at edges of exactly two triangles, and over
/// cracks and T-junctions, where open edges nearly lie on each other. Of all that hangs together most of the area keeps
/// its side; parts that enclose something and meet others have theirs outside. Vertices keep their numbers; attributes
/// of corners follow. Returns how many triangles were reversed.
std::size_t orient_soup(TriangleMesh& mesh);

}  // namespace pelage
