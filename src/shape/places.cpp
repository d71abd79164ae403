#include "shape/places.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pelage {

std::vector<std::int32_t> same_places(const std::vector<Point>& points, const std::vector<char>& compared) {
  struct Entry {
    Point point;
    std::int32_t vertex;
  };
  std::vector<Entry> entries;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto& [x, y, z] = points[v];
    if (compared[v] && std::isfinite(x) && std::isfinite(y) && std::isfinite(z))
      entries.push_back({points[v], static_cast<std::int32_t>(v)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.point != b.point ? a.point < b.point : a.vertex < b.vertex;
  });
  std::vector<std::int32_t> place(points.size());
  std::iota(place.begin(), place.end(), 0);
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (entries[i].point == entries[i - 1].point) place[entries[i].vertex] = place[entries[i - 1].vertex];
  return place;
}

}  // namespace pelage
