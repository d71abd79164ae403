#include "shape/cell_values.h"

#include <algorithm>
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
  for (double radius = cells_.radius; radius <= 8 * cells_.radius; radius *= 2)
    if (const std::int32_t cell = neighbours_.nearest(place, radius); cell >= 0) return cell;
  const auto square = [&](const Point& p) { return dot(difference(p, place), difference(p, place)); };
  const auto best = std::ranges::min_element(cells_.points, {}, square);
  return static_cast<std::int32_t>(best - cells_.points.begin());
}

}  // namespace pelage
