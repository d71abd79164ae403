#pragma once
// STL: triangles without shared vertices; positions as 32-bit floats.

#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The bytes of an STL file, facet normals from the winding (0 0 0 for a degenerate triangle). Binary, with the colours
/// of the faces, 5 bits each, in the attribute bytes as most programs write them. A mesh whose faces belong to named
/// objects, and have no colours, is written as text with a solid for each.
std::string encode_stl(const TriangleMesh& mesh);

/// The attribute that becomes the colours, or nullptr; and that of the solids.
const Attribute* stl_color(const std::vector<Attribute>& attributes);
const Attribute* stl_object(const std::vector<Attribute>& attributes);

}  // namespace pelage
