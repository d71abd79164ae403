#pragma once
// OFF (text): vertices and triangles; coordinates read back as the same doubles, attributes are left out.

#include <string>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The text of an OFF file.
std::string encode_off(const TriangleMesh& mesh);

}  // namespace pelage
