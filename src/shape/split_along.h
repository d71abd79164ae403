#pragma once
// Surfaces whose triangles are split along lines, so that what changes there changes between vertices on the line.

#include "shape/cut_surface.h"

namespace pelage {

/// Splits triangles along the line where the level function is 0, which is found along every edge with a change of sign
/// and by which it jumps by more than `least_jump`; the line between is straight on each triangle. New vertices lie
/// next to the line where the function is not above 0, also where it has no value between. Vertices that there were
/// come first; triangles that share an edge share its new vertex.
CutSurface split_along(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                       const LevelFunction& level, double least_jump);

}  // namespace pelage
