#pragma once
// Bounding boxes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "pelage/point.h"

namespace pelage {

/// The smallest box with sides along the axes that contains some points; without any, low lies above high.
struct Box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low = {infinity, infinity, infinity}, high = {-infinity, -infinity, -infinity};

  void add(const Point& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  Point middle() const { return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}; }
  /// Length of the diagonal; 0 without points.
  double diagonal() const {
    return low[0] <= high[0] ? std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) : 0;
  }
};

inline Box box_of(std::span<const Point> points) {
  Box box;
  for (const Point& p : points) box.add(p);
  return box;
}

}  // namespace pelage
