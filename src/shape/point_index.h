#pragma once
// Points found by their places: a uniform grid of boxes, of which those with points are kept by hash.

#include <cstdint>
#include <span>
#include <vector>

#include "pelage/point.h"

namespace pelage {

class PointIndex {
 public:
  /// Boxes have sides of this length, which is positive [world units]; queries of about that radius are the fastest.
  PointIndex(std::span<const Point> points, double side);

  /// Calls visit(index, square of the distance) for all points within the radius; always in the same order.
  template <class Visit>
  void for_each_within(const Point& from, double radius, Visit&& visit) const;

 private:
  using Box = std::array<std::int64_t, 3>;
  struct Entry {
    Point point;
    std::int32_t index;
  };

  Box box_of(const Point& p) const;
  std::size_t bucket_of(const Box& box) const {
    const auto key = [&](std::size_t k) { return static_cast<std::uint64_t>(box[k]); };
    const std::uint64_t mixed = (key(0) * 0x9e3779b97f4a7c15ULL + key(1)) * 0xbf58476d1ce4e5b9ULL + key(2);
    return static_cast<std::size_t>((mixed ^ (mixed >> 31)) * 0x94d049bb133111ebULL >> 20) & mask_;
  }

  double side_;
  std::size_t mask_ = 0;
  std::vector<std::int32_t> start_;  ///< of every bucket in entries_, and the end
  std::vector<Entry> entries_;
  std::vector<Box> box_;  ///< of the entries
};

template <class Visit>
void PointIndex::for_each_within(const Point& from, double radius, Visit&& visit) const {
  const Box low = box_of({from[0] - radius, from[1] - radius, from[2] - radius});
  const Box high = box_of({from[0] + radius, from[1] + radius, from[2] + radius});
  for (std::int64_t z = low[2]; z <= high[2]; ++z)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t x = low[0]; x <= high[0]; ++x) {
        const std::size_t b = bucket_of({x, y, z});
        for (auto k = static_cast<std::size_t>(start_[b]); k < static_cast<std::size_t>(start_[b + 1]); ++k) {
          if (box_[k][0] != x || box_[k][1] != y || box_[k][2] != z) continue;
          const Point& p = entries_[k].point;
          const double dx = p[0] - from[0], dy = p[1] - from[1], dz = p[2] - from[2];
          const double square = dx * dx + dy * dy + dz * dz;
          if (square <= radius * radius) visit(entries_[k].index, square);
        }
      }
}

}  // namespace pelage
