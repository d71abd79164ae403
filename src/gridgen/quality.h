#pragma once
// How good a grid is.

#include "gridgen/sheet.h"

namespace pelage {

struct GridQuality {
  double smallest_area = 0;   ///< of the triangles in the corners of cells, over their mean; negative where folded
  double smallest_angle = 0;  ///< of all corners of cells [degrees]; negative where folded
  double largest_angle = 0;   ///< [degrees]
  double skew = 0;            ///< the mean distance of the angles from 90 degrees [degrees]
  std::size_t folded = 0;     ///< cells with a corner that is folded or flat
};

/// Of nodes in space; which corners are folded is told in the plane.
GridQuality grid_quality(const Sheet& sheet, const std::vector<Point>& plane, const std::vector<Point>& space);

}  // namespace pelage
