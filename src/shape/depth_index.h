#pragma once
// What of a surface hides a place from an orthographic view.

#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Triangles in a view: x to the right, y upwards, z towards the viewer. Keeps references to all.
class DepthIndex {
 public:
  DepthIndex(const std::vector<Triangle>& triangles, const std::vector<Point>& points);

  /// Whether a triangle lies before a place by more than `gap`.
  bool hides(const Point& place, double gap) const;

 private:
  struct Range {
    int first, last;
  };
  Range cells(std::size_t axis, double low, double high) const;
  bool before(const Triangle& t, const Point& place, double gap) const;

  const std::vector<Triangle>& triangles_;
  const std::vector<Point>& points_;
  std::array<double, 2> low_{}, per_unit_{};
  std::array<int, 2> count_{1, 1};
  std::vector<std::size_t> first_;      ///< per cell of a grid over x and y: where its triangles begin
  std::vector<std::int32_t> in_cells_;  ///< their numbers
};

}  // namespace pelage
