#pragma once
// Surfaces with holes where a function is above 0.

#include "shape/cut_surface.h"

namespace pelage {

/// What is left of a surface.
struct PerforatedSurface : CutSurface {
  std::size_t islands = 0;           ///< parts that hung on nothing and were left out
  double island_area = 0, area = 0;  ///< theirs, and of what is left [world units^2]
};

/// Cuts a manifold surface where the level function, above 0 in holes, is 0, which is found along every edge with a
/// change of sign; the line between is straight on each triangle. Vertices that lie next to it move onto it, but for
/// those on creases and borders, from which it keeps a twentieth of the edge: so no triangle is a sliver. What is left
/// is manifold: where two holes would touch in a vertex they end before. Of every connected part of the surface the
/// largest piece is kept. Without triangles where nothing is left; as it was where there is no hole.
PerforatedSurface perforated(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                             const LevelFunction& level);

}  // namespace pelage
