#pragma once
// Direction fields on cells.

#include <optional>
#include <vector>

#include "direction/guides.h"
#include "pelage/cells.h"

namespace pelage {

/// A unit tangent per cell, of either sense. `given`: vectors that cells follow, 0 for none, or empty. Where a cell has
/// none, lines are those of the smoothest field (of the connection Laplacian on the neighbours, whose planes are
/// unfolded) between the others.
std::vector<Point> cell_lines(const Cells& cells, const std::vector<Point>& given);

/// What a wish for an axis or a centre alone asks of each cell; 0 where it lies along the normal.
std::vector<Point> wished_on_cells(const Cells& cells, const FieldWish& wish);

}  // namespace pelage
