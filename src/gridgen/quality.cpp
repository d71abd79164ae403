#include "gridgen/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/vectors.h"

namespace pelage {

namespace {

std::array<Point, 4> corner_points(const Sheet& sheet, std::size_t cell, const std::vector<Point>& x) {
  const auto v = sheet.corners(cell);
  return {x[v[0]], x[v[1]], x[v[2]], x[v[3]]};
}

}  // namespace

GridQuality grid_quality(const Sheet& sheet, const std::vector<Point>& plane, const std::vector<Point>& space) {
  GridQuality quality{INFINITY, 180, 0, 0, 0};
  double areas = 0, skews = 0;
  for (std::size_t c = 0; c < sheet.cells(); ++c) {
    const CellEdges flat(corner_points(sheet, c, plane)), edges(corner_points(sheet, c, space));
    const auto signs = flat.corners(), corners = edges.corners();
    bool folded = false;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool here = !(plane_cross(signs[k].along, signs[k].across) > 0);
      const double area = length(cross(corners[k].along, corners[k].across)) * (here ? -1 : 1);
      // In the second and the fourth corner the edges run into and out of it.
      const double inner = dot(corners[k].along, corners[k].across) * (k % 2 ? -1 : 1);
      const double angle = std::atan2(area, inner) * 180 / std::numbers::pi;
      quality.smallest_area = std::min(quality.smallest_area, area);
      quality.smallest_angle = std::min(quality.smallest_angle, angle);
      quality.largest_angle = std::max(quality.largest_angle, angle);
      areas += area;
      skews += std::abs(angle - 90);
      folded = folded || here;
    }
    quality.folded += folded;
  }
  const double corners = 4 * static_cast<double>(sheet.cells());
  quality.smallest_area /= areas / corners;
  quality.skew = skews / corners;
  return quality;
}

}  // namespace pelage
