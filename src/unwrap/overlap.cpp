#include "unwrap/overlap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shape/edges.h"
#include "unwrap/outline.h"

namespace pelage {

namespace {

struct Segment {
  Flat a, b;
};

/// Beside the size of the chart: what is nearer counts as touching, far more than later rounding moves anything.
constexpr double touching = 1e-6;

/// Distance of p from the line of a segment, to the left.
double side_of(const Segment& s, const Flat& p) {
  const double x = s.b[0] - s.a[0], y = s.b[1] - s.a[1];
  return (x * (p[1] - s.a[1]) - y * (p[0] - s.a[0])) / std::hypot(x, y);
}

bool apart_across(const Segment& s, const Segment& other, double near) {
  const double a = side_of(s, other.a), b = side_of(s, other.b);
  return (a > near && b > near) || (a < -near && b < -near);
}

bool apart_along(const Segment& s, const Segment& t, double near) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::min(s.a[k], s.b[k]) > std::max(t.a[k], t.b[k]) + near) return true;
    if (std::min(t.a[k], t.b[k]) > std::max(s.a[k], s.b[k]) + near) return true;
  }
  return false;
}

bool meet(const Segment& s, const Segment& t, double near) {
  return !apart_along(s, t, near) && !apart_across(s, t, near) && !apart_across(t, s, near);
}

/// Squares with the segments whose boxes meet them.
class SegmentGrid {
 public:
  SegmentGrid(const std::vector<Segment>& segments, const FlatBox& box) : box_(box) {
    const double width = box.high[0] - box.low[0], height = box.high[1] - box.low[1];
    const auto n = static_cast<double>(segments.size());
    cell_ = std::max(std::sqrt(width * height / n), std::max(width, height) / n);
    for (std::size_t k = 0; k < 2; ++k) count_[k] = index(box.high[k], k) + 1;
    cells_.resize(static_cast<std::size_t>(count_[0] * count_[1]));
    for (std::size_t s = 0; s < segments.size(); ++s)
      visit(segments[s], [&](std::vector<std::int32_t>& cell) { cell.push_back(static_cast<std::int32_t>(s)); });
  }
  const std::vector<std::vector<std::int32_t>>& cells() const { return cells_; }

 private:
  std::int64_t index(double x, std::size_t k) const { return static_cast<std::int64_t>((x - box_.low[k]) / cell_); }
  /// A cell more all around, so that no two segments that nearly meet are missed.
  template <class Action>
  void visit(const Segment& s, const Action& action) {
    std::array<std::int64_t, 2> first, last;
    for (std::size_t k = 0; k < 2; ++k) {
      first[k] = std::max<std::int64_t>(index(std::min(s.a[k], s.b[k]) - 0.01 * cell_, k), 0);
      last[k] = std::min(index(std::max(s.a[k], s.b[k]) + 0.01 * cell_, k), count_[k] - 1);
    }
    for (std::int64_t y = first[1]; y <= last[1]; ++y)
      for (std::int64_t x = first[0]; x <= last[0]; ++x) action(cells_[static_cast<std::size_t>(y * count_[0] + x)]);
  }

  FlatBox box_;
  double cell_ = 0;
  std::array<std::int64_t, 2> count_{};
  std::vector<std::vector<std::int32_t>> cells_;
};

}  // namespace

bool border_meets_itself(const Chart& chart) {
  const std::vector<std::int32_t> border = border_of(chart);
  std::vector<Segment> segments;
  FlatBox box;
  for (const HalfEdge h : border) {
    segments.push_back({chart.uv[tail(chart.triangles, h)], chart.uv[tip(chart.triangles, h)]});
    box.add(segments.back().a);
  }
  const double near = touching * std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  const auto last = static_cast<std::int32_t>(segments.size()) - 1;
  const SegmentGrid grid(segments, box);
  for (const std::vector<std::int32_t>& cell : grid.cells())
    for (std::size_t i = 0; i < cell.size(); ++i)
      for (std::size_t j = i + 1; j < cell.size(); ++j) {
        const bool neighbours = cell[j] - cell[i] == 1 || (cell[i] == 0 && cell[j] == last);
        if (!neighbours && meet(segments[cell[i]], segments[cell[j]], near)) return true;
      }
  return false;
}

}  // namespace pelage
