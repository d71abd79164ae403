#pragma once
// OFF (text).

#include <string>

#include "pelage/polygon_mesh.h"

namespace pelage {

/// The text of an OFF file: vertices and faces, coordinates read back as the same doubles; "color" as r g b a from 0 to
/// 255 (sRGB, alpha linear), behind the coordinates of the vertices (COFF) or behind the corners of the faces. Other
/// attributes are left out: few programs read the kinds of OFF that have more.
std::string encode_off(const PolygonMesh& mesh);

}  // namespace pelage
