#pragma once
// STL (binary): triangles without shared vertices; positions as 32-bit floats, attributes are left out.

#include <string>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The bytes of an STL file, facet normals from the winding (0 0 0 for a degenerate triangle).
std::string encode_stl(const TriangleMesh& mesh);

}  // namespace pelage
