#include "shape/depth_index.h"

#include <algorithm>
#include <cmath>

#include "base/box.h"

namespace pelage {

DepthIndex::DepthIndex(const std::vector<Triangle>& triangles, const std::vector<Point>& points)
    : triangles_(triangles), points_(points) {
  const Box box = box_of(points);
  // About one cell for every triangle that looks forward.
  const int side = static_cast<int>(std::clamp(std::sqrt(static_cast<double>(triangles.size()) / 2), 1.0, 2000.0));
  for (std::size_t d = 0; d < 2; ++d) {
    low_[d] = box.low[d];
    count_[d] = side;
    per_unit_[d] = box.high[d] > box.low[d] ? side / (box.high[d] - box.low[d]) : 0;
  }
  first_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) + 1, 0);
  const auto each_cell = [&](std::size_t f, auto&& visit) {
    std::array<Range, 2> range{};
    for (std::size_t d = 0; d < 2; ++d) {
      const auto [low, high] =
          std::minmax({points_[triangles_[f][0]][d], points_[triangles_[f][1]][d], points_[triangles_[f][2]][d]});
      range[d] = cells(d, low, high);
    }
    for (int j = range[1].first; j <= range[1].last; ++j)
      for (int i = range[0].first; i <= range[0].last; ++i) visit(static_cast<std::size_t>(i + side * j));
  };
  for (std::size_t f = 0; f < triangles.size(); ++f) each_cell(f, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  in_cells_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    each_cell(f, [&](std::size_t cell) { in_cells_[next[cell]++] = static_cast<std::int32_t>(f); });
}

DepthIndex::Range DepthIndex::cells(std::size_t axis, double low, double high) const {
  const auto cell = [&](double x) {
    return static_cast<int>(std::clamp((x - low_[axis]) * per_unit_[axis], 0.0, count_[axis] - 1.0));
  };
  return {cell(low), cell(high)};
}

bool DepthIndex::before(const Triangle& t, const Point& place, double gap) const {
  const Point &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
  const auto area = [](const Point& p, const Point& q, const Point& r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  const double whole = area(a, b, c);
  if (whole == 0) return false;  // seen from the side
  const double u = area(place, b, c) / whole, v = area(a, place, c) / whole, w = 1 - u - v;
  return u >= 0 && v >= 0 && w >= 0 && u * a[2] + v * b[2] + w * c[2] > place[2] + gap;
}

bool DepthIndex::hides(const Point& place, double gap) const {
  const std::size_t cell =
      static_cast<std::size_t>(cells(0, place[0], place[0]).first) +
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(cells(1, place[1], place[1]).first);
  return std::any_of(in_cells_.begin() + static_cast<std::ptrdiff_t>(first_[cell]),
                     in_cells_.begin() + static_cast<std::ptrdiff_t>(first_[cell + 1]),
                     [&](std::int32_t f) { return before(triangles_[f], place, gap); });
}

}  // namespace pelage
