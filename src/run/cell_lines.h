#pragma once
// Direction fields on cells: those of meshes (direction/), with the sides between cells for links.

#include <vector>

#include "direction/guides.h"
#include "pelage/cells.h"

namespace pelage {

/// A unit tangent per cell, of either sense: the field of lines that follows a wish.
std::vector<Point> wished_lines(const Cells& cells, const FieldWish& wish);

/// The same where cells are given vectors to follow, 0 for none: their own exactly, and the smoothest field between
/// them. `given` may be empty.
std::vector<Point> completed_lines(const Cells& cells, const std::vector<Point>& given);

}  // namespace pelage
