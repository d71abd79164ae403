#include "shape/cell_voronoi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage {

void PlaneCell::clip(const PlanePoint& q, double limit, const Beyond& what) {
  const std::size_t n = corner.size();
  const auto height = [&](std::size_t k) { return q[0] * corner[k][0] + q[1] * corner[k][1] - limit; };
  bool cut = false;
  for (std::size_t k = 0; k < n && !cut; ++k) cut = height(k) > 0;
  if (!cut) return;
  std::vector<PlanePoint> kept;
  std::vector<Beyond> behind;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const double h = height(k), g = height(next);
    if (h <= 0) {
      kept.push_back(corner[k]);
      behind.push_back(beyond[k]);
    }
    if ((h <= 0) == (g <= 0)) continue;
    const double t = h / (h - g);
    kept.push_back(
        {corner[k][0] + t * (corner[next][0] - corner[k][0]), corner[k][1] + t * (corner[next][1] - corner[k][1])});
    behind.push_back(h <= 0 ? what : beyond[k]);
  }
  corner = std::move(kept);
  beyond = std::move(behind);
}

double PlaneCell::area() const {
  double sum = 0;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const PlanePoint &a = corner[k], &b = corner[(k + 1) % corner.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum / 2;
}

double PlaneCell::side_length(std::size_t k) const {
  const PlanePoint &a = corner[k], &b = corner[(k + 1) % corner.size()];
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

double PlaneCell::furthest_square() const {
  double most = 0;
  for (const PlanePoint& p : corner) most = std::max(most, p[0] * p[0] + p[1] * p[1]);
  return most;
}

TangentFrame::TangentFrame(const Point& normal)
    : e(unit(cross(normal, std::abs(normal[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0}))), f(cross(normal, e)) {}

PlaneCell voronoi_cell(std::vector<PlaneNeighbour>& neighbours, double reach) {
  constexpr int sides = 12;
  PlaneCell cell;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    cell.corner.push_back({reach * std::cos(angle), reach * std::sin(angle)});
    cell.beyond.emplace_back();
  }
  std::ranges::sort(neighbours, [](const PlaneNeighbour& a, const PlaneNeighbour& b) {
    return a.square != b.square ? a.square < b.square : a.cell < b.cell;
  });
  double furthest = reach * reach;
  for (const PlaneNeighbour& n : neighbours) {
    if (n.square > 4 * furthest) break;
    if (!(n.square > 0)) continue;
    cell.clip(n.at, n.square / 2, {n.cell, std::sqrt(n.square)});
    furthest = cell.furthest_square();
  }
  return cell;
}

}  // namespace pelage
