#include "shape/cell_values.h"

#include <cmath>

namespace pelage {

void CellValues::at(const Point& place, const Point& normal, std::vector<Weight>& found) const {
  const double s = 2 * cells_.radius;
  found.clear();
  double sum = 0;
  Point slope{};
  neighbours_.for_each(place, normal, s, [&](const CellNeighbour& n) {
    const double d = std::sqrt(n.square) / s;
    Weight weight{n.cell, (2 * d - 3) * d * d + 1, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      weight.slope[k] = 6 * (1 - d) / (s * s) * n.way[k];
      slope[k] += weight.slope[k];
    }
    sum += weight.share;
    found.push_back(weight);
  });
  for (Weight& w : found) {
    w.share /= sum;
    for (std::size_t k = 0; k < 3; ++k) w.slope[k] = (w.slope[k] - w.share * slope[k]) / sum;
  }
  if (found.empty()) found.push_back({nearest(place), 1, {}});
}

std::int32_t CellValues::nearest(const Point& place) const {
  std::call_once(tree_made_, [&] {
    TriangleMesh points{cells_.points, {}, {}};
    for (std::int32_t i = 0; i < std::ssize(points.points); ++i) points.triangles.push_back({i, i, i});
    tree_ = std::make_unique<const DistanceTree>(points);
  });
  return tree_->nearest(place);
}

}  // namespace pelage
