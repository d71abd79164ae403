#include "shape/edges.h"

#include <algorithm>
#include <utility>

namespace pelage {

EdgeTable::EdgeTable(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  const HalfEdge count = static_cast<HalfEdge>(3 * triangles.size());
  auto smaller = [&](HalfEdge h) { return std::min(tail(triangles, h), tip(triangles, h)); };
  auto larger = [&](HalfEdge h) { return std::max(tail(triangles, h), tip(triangles, h)); };

  // Counting sort by the smaller vertex; begin[v] ends up as the end of the group of v.
  std::vector<std::size_t> begin(vertex_count + 1, 0);
  for (HalfEdge h = 0; h < count; ++h) ++begin[smaller(h) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<std::pair<std::int32_t, HalfEdge>> sorted(count);
  for (HalfEdge h = 0; h < count; ++h) sorted[begin[smaller(h)]++] = {larger(h), h};

  half_edges_.reserve(count);
  first_.reserve(count / 2 + 1);
  std::size_t from = 0;
  for (std::size_t v = 0; v < vertex_count; from = begin[v++]) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(from),
              sorted.begin() + static_cast<std::ptrdiff_t>(begin[v]));
    for (std::size_t i = from; i < begin[v]; ++i) {
      if (i == from || sorted[i].first != sorted[i - 1].first) first_.push_back(half_edges_.size());
      half_edges_.push_back(sorted[i].second);
    }
  }
  first_.push_back(half_edges_.size());
}

}  // namespace pelage
