#pragma once
// Cells to be looked at.

#include "pelage/cells.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// Every cell with a dark seam and a dark dot at its point; those of six sides are pale, of fewer blue, of more red.
TriangleMesh cells_to_see(const Cells& cells);

}  // namespace pelage
