#include "shape/soup_edges.h"

#include <algorithm>
#include <numeric>

#include "shape/places.h"

namespace pelage {

namespace {

struct Side {
  std::array<std::int32_t, 2> ends;  ///< ascending
  std::int32_t halfedge;
};

/// In order of their ends; `place` of the vertices.
std::vector<Side> sides_of(const std::vector<Triangle>& triangles, const std::vector<std::int32_t>& place) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = place[static_cast<std::size_t>(t[k])], b = place[static_cast<std::size_t>(t[(k + 1) % 3])];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(sides.size())});
    }
  std::ranges::sort(
      sides, [](const Side& a, const Side& b) { return a.ends != b.ends ? a.ends < b.ends : a.halfedge < b.halfedge; });
  return sides;
}

/// Calls visit(first, last) for the sides of every edge.
template <class Visit>
void for_edges(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
    for (end = k; end < sides.size() && sides[end].ends == sides[k].ends;) ++end;
    visit(k, end);
  }
}

}  // namespace

std::vector<std::int32_t> soup_twins(const TriangleMesh& mesh) {
  const std::vector<Side> sides =
      sides_of(mesh.triangles, same_places(mesh.points, std::vector<char>(mesh.points.size(), 1)));
  std::vector<std::int32_t> twin(sides.size(), -1);
  for_edges(sides, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    for (std::size_t s = begin; s < end; ++s)
      twin[static_cast<std::size_t>(sides[s].halfedge)] = count == 2  ? sides[2 * begin + 1 - s].halfedge
                                                          : count > 2 ? -2
                                                                      : -1;
  });
  return twin;
}

Topology soup_topology(std::size_t vertex_count, std::vector<Triangle> triangles) {
  std::vector<std::int32_t> place(vertex_count);
  std::iota(place.begin(), place.end(), 0);
  const std::vector<Side> sides = sides_of(triangles, place);
  Topology t;
  t.vertex_count = static_cast<Index>(vertex_count);
  t.triangles = std::move(triangles);
  t.twin.assign(sides.size(), -1);
  for_edges(sides, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const Index a = sides[begin].halfedge, b = sides[begin + 1].halfedge;
    if (t.origin(a) != t.target(b)) return;
    t.twin[static_cast<std::size_t>(a)] = b;
    t.twin[static_cast<std::size_t>(b)] = a;
  });
  number_from_twins(t);
  return t;
}

}  // namespace pelage
