#pragma once
// Surfaces whose triangles are split along lines, so that what changes there changes between vertices on the line.

#include "shape/cut_surface.h"

namespace pelage {

/// What is worth a cut: a change along an edge that is larger, on an edge that is not shorter.
struct Jump {
  double jump = 0, length = 0;
};

/// Splits triangles along the line where the level function is 0, which is found along every edge that is worth it and
/// has a change of sign; the line between is straight on each triangle. New vertices lie 0.03 of an edge beside
/// the line, where the function is not above 0, also where it has no value between. Vertices that there were come
/// first; triangles that share an edge share its new vertex.
CutSurface split_along(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                       const LevelFunction& level, const Jump& least);

}  // namespace pelage
