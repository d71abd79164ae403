#include "shape/one_sided.h"

#include <algorithm>
#include <numeric>

#include "shape/topology.h"

namespace pelage {

namespace {

/// Of numbers that stand for the smallest of those that they are united with.
Index root(std::vector<Index>& parent, Index a) {
  while (parent[static_cast<std::size_t>(a)] != a)
    a = parent[static_cast<std::size_t>(a)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(a)])];
  return a;
}

void unite(std::vector<Index>& parent, Index a, Index b) {
  a = root(parent, a);
  b = root(parent, b);
  parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

struct Halfedge {
  Index from, to, number;
};

std::pair<Index, Index> ends_of(const Halfedge& e) { return {e.from, e.to}; }

/// By their ends.
std::vector<Halfedge> sorted_halfedges(const std::vector<Triangle>& triangles) {
  std::vector<Halfedge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({triangles[f][k], triangles[f][(k + 1) % 3], static_cast<Index>(3 * f + k)});
  std::ranges::sort(edges, {}, ends_of);
  return edges;
}

}  // namespace

std::vector<Index> cut_between_sides(std::vector<Triangle>& triangles, std::size_t vertices) {
  // Corners of one vertex belong together where triangles with opposite directions along an edge join them.
  std::vector<Index> parent(3 * triangles.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const std::vector<Halfedge> edges = sorted_halfedges(triangles);
  for (const Halfedge& e : edges) {
    // Clang before 16 has no ranges of iterators, which equal_range() would return.
    auto o = std::ranges::lower_bound(edges, std::pair{e.to, e.from}, {}, ends_of);
    for (; o != edges.end() && ends_of(*o) == std::pair{e.to, e.from}; ++o) {
      unite(parent, e.number, next_halfedge(o->number));
      unite(parent, next_halfedge(e.number), o->number);
    }
  }
  std::vector<Index> before(vertices), number(parent.size(), -1);
  std::iota(before.begin(), before.end(), Index{0});
  std::vector<char> met(vertices, 0);
  for (std::size_t c = 0; c < parent.size(); ++c) {
    Index& corner = triangles[c / 3][c % 3];
    Index& n = number[static_cast<std::size_t>(root(parent, static_cast<Index>(c)))];
    if (n < 0) {
      n = corner;
      if (met[static_cast<std::size_t>(corner)]) {
        n = static_cast<Index>(before.size());
        before.push_back(corner);
      }
      met[static_cast<std::size_t>(corner)] = 1;
    }
    corner = n;
  }
  return before;
}

}  // namespace pelage
