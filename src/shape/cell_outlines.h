#pragma once
// Cells as polygons (Turk 1991, figure 7).

#include "pelage/cells.h"
#include "pelage/polygon_mesh.h"

namespace pelage {

/// A polygon for every cell, in its tangent plane: vertices are first the points of the cells, which are in no face,
/// then the corners of cell after cell. Faces have "sides", the number of other cells around, and "area".
PolygonMesh outlines_of(const Cells& cells);

}  // namespace pelage
