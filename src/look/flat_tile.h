#pragma once
// A flat mesh seen from above, as a small picture.

#include "pelage/image.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// The part [0, 1]^2 of the plane z = 0, y upwards, `size` pixels wide and high; "color" at the vertices (linear light)
/// is interpolated. Pixels that no triangle covers stay black.
Image flat_tile(const TriangleMesh& mesh, int size);

}  // namespace pelage
