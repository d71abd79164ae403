#include "shape/point_index.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/checked.h"

namespace pelage {

PointIndex::PointIndex(std::span<const Point> points, double side) : side_(side) {
  mask_ = std::bit_ceil(points.size() + 1) - 1;
  start_.assign(mask_ + 2, 0);
  std::vector<std::size_t> bucket(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bucket[i] = bucket_of(box_of(points[i]));
    ++start_[bucket[i] + 1];
  }
  for (std::size_t b = 0; b <= mask_; ++b) start_[b + 1] += start_[b];
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  entries_.resize(points.size());
  box_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto k = static_cast<std::size_t>(next[bucket[i]]++);
    entries_[k] = {points[i], static_cast<std::int32_t>(i)};
    box_[k] = box_of(points[i]);
  }
}

PointIndex::Box PointIndex::box_of(const Point& p) const {
  constexpr auto last = std::int64_t{1} << 62;  // what lies further out shares a box that loops can count beyond
  Box box;
  for (std::size_t k = 0; k < 3; ++k)
    box[k] = std::clamp(saturated<std::int64_t>(std::floor(p[k] / side_)), -last, last);
  return box;
}

}  // namespace pelage
