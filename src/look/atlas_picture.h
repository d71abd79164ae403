#pragma once
// Texture coordinates as a picture.

#include <cstdint>
#include <vector>

#include "pelage/image.h"
#include "pelage/polygon_mesh.h"

namespace pelage {

/// The unit square of a mesh's "uv" (per corner), v upwards, `size` pixels wide: every face in a colour of its chart,
/// `chart` per face, -1 for what is not drawn; borders of charts and seams as lines.
Image atlas_picture(const PolygonMesh& mesh, const std::vector<std::int32_t>& chart, int size);

}  // namespace pelage
