#pragma once
// Coats on cells, as samples on what the cells lie on.

#include "look/tessellation.h"

namespace pelage {

/// Triangles are split as the colours need and keep their vertices first and unmoved; a cloud has its own points.
/// Values are those of CellValues. `fields` has nodes, which are cells.
Tessellation tessellate_cells(const CoatFields& fields, const TessellationRequest& request);

}  // namespace pelage
