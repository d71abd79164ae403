#pragma once
// Strokes of a brush on a surface: how much of the paint comes to each of its points.

#include <vector>

#include "pelage/point.h"

namespace pelage {

struct BrushStroke {
  std::vector<Point> points;  ///< a polyline near the surface, or a single dab [world units]
  double radius = 0;          ///< of the disc that the brush covers [world units]
  double hardness = 0.5;      ///< the share of the radius that gets all of the paint; beyond it fades to the edge
};

/// Shares from 0 to 1, at places with these unit normals. Through a thin part paint does not come: a place turned away
/// from the surface where the stroke passes nearest gets none. Without normals it comes to all around.
std::vector<double> stroke_shares(const BrushStroke& stroke, const std::vector<Point>& positions,
                                  const std::vector<Point>& normals);

}  // namespace pelage
