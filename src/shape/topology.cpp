#include "shape/topology.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "pelage/error.h"

namespace pelage {

namespace {

std::string name(Index face) { return "face " + std::to_string(face); }

/// A halfedge in the group of the smaller of its two vertices.
struct GroupedHalfedge {
  Index larger;  ///< of its two vertices
  Index halfedge;
  auto operator<=>(const GroupedHalfedge&) const = default;
};

/// `start` has vertex_count + 1 entries.
struct HalfedgesByVertex {
  std::vector<Index> start;
  std::vector<GroupedHalfedge> entry;
};

HalfedgesByVertex group_by_smaller_vertex(const Topology& t) {
  const auto halfedges = static_cast<Index>(3 * t.triangles.size());
  HalfedgesByVertex groups;
  groups.start.assign(static_cast<std::size_t>(t.vertex_count) + 1, 0);
  auto smaller = [&](Index h) { return static_cast<std::size_t>(std::min(t.origin(h), t.target(h))); };
  for (Index h = 0; h < halfedges; ++h) ++groups.start[smaller(h) + 1];
  for (std::size_t v = 1; v < groups.start.size(); ++v) groups.start[v] += groups.start[v - 1];
  groups.entry.resize(static_cast<std::size_t>(halfedges));
  std::vector<Index> cursor(groups.start.begin(), groups.start.end() - 1);
  for (Index h = 0; h < halfedges; ++h)
    groups.entry[static_cast<std::size_t>(cursor[smaller(h)]++)] = {std::max(t.origin(h), t.target(h)), h};
  return groups;
}

/// Pairs the halfedges between the same two vertices.
void pair_same(Topology& t, const GroupedHalfedge* begin, const GroupedHalfedge* end) {
  for (const GroupedHalfedge* p = begin; p != end; ++p) {
    for (const GroupedHalfedge* q = p + 1; q != end; ++q) {
      const Index a = p->halfedge, b = q->halfedge;
      Index& twin_a = t.twin[static_cast<std::size_t>(a)];
      Index& twin_b = t.twin[static_cast<std::size_t>(b)];
      if (t.origin(a) == t.origin(b) || twin_a >= 0 || twin_b >= 0)
        throw Error(Fault::input, name(a / 3) + " and " + name(b / 3) +
                                      " meet at a non-manifold or inconsistently oriented edge; repair the mesh first");
      twin_a = b;
      twin_b = a;
    }
  }
}

/// The groups are short; of a long one (high valence) only equal far vertices are compared.
void pair_halfedges(Topology& t) {
  HalfedgesByVertex groups = group_by_smaller_vertex(t);
  parallel_for(static_cast<std::size_t>(t.vertex_count), [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      GroupedHalfedge* begin = groups.entry.data() + groups.start[v];
      GroupedHalfedge* end = groups.entry.data() + groups.start[v + 1];
      std::sort(begin, end);
      for (GroupedHalfedge* a = begin; a != end;) {
        GroupedHalfedge* b = std::find_if(a, end, [&](const GroupedHalfedge& h) { return h.larger != a->larger; });
        pair_same(t, a, b);
        a = b;
      }
    }
  });
}

/// In the order of the first half-edge of each.
void number_edges(Topology& t) {
  const std::size_t halfedges = t.twin.size();
  const auto first = [&](std::size_t h) { return t.twin[h] < 0 || static_cast<std::size_t>(t.twin[h]) > h; };
  std::vector<Index> start(chunk_count(halfedges) + 1, 0);
  parallel_for(halfedges, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) start[begin / default_chunk + 1] += first(h);
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  t.edge_count = start.back();
  t.edge.resize(halfedges);
  parallel_for(halfedges, [&](std::size_t begin, std::size_t end) {
    Index next = start[begin / default_chunk];
    for (std::size_t h = begin; h < end; ++h)
      if (first(h)) t.edge[h] = next++;
  });
  parallel_for(halfedges, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h)
      if (!first(h)) t.edge[h] = t.edge[static_cast<std::size_t>(t.twin[h])];
  });
}

/// Prefers the boundary halfedge, so that a walk counter-clockwise meets the whole fan.
void choose_outgoing(Topology& t) {
  t.outgoing.assign(static_cast<std::size_t>(t.vertex_count), -1);
  for (std::size_t h = 0; h < t.twin.size(); ++h) {
    Index& out = t.outgoing[static_cast<std::size_t>(t.origin(static_cast<Index>(h)))];
    if (out < 0 || t.twin[h] < 0) out = static_cast<Index>(h);
  }
}

/// A vertex is manifold when the walk around it meets all its triangles.
void check_vertices(const Topology& t) {
  std::vector<Index> corners(static_cast<std::size_t>(t.vertex_count), 0);
  for (const Triangle& triangle : t.triangles)
    for (Index v : triangle) ++corners[static_cast<std::size_t>(v)];
  parallel_for(corners.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Index start = t.outgoing[v];
      Index met = 0;
      for (Index h = start; h >= 0; h = t.rotate(h)) {
        ++met;
        if (t.rotate(h) == start) break;
      }
      if (met != corners[v])
        throw Error(Fault::input,
                    "vertex " + std::to_string(v) + " joins several fans of faces; repair the mesh first");
    }
  });
}

}  // namespace

void Topology::one_ring(Index vertex, std::vector<Index>& ring) const {
  ring.clear();
  const Index start = outgoing[static_cast<std::size_t>(vertex)];
  for (Index h = start; h >= 0;) {
    ring.push_back(target(h));
    const Index following = rotate(h);
    if (following < 0) ring.push_back(origin(previous_halfedge(h)));
    if (following == start) break;
    h = following;
  }
}

Topology make_topology(std::size_t vertex_count, std::vector<Triangle> triangles) {
  Topology t;
  t.vertex_count = static_cast<Index>(vertex_count);
  t.triangles = std::move(triangles);
  t.twin.assign(3 * t.triangles.size(), -1);
  pair_halfedges(t);
  number_from_twins(t);
  check_vertices(t);
  return t;
}

void number_from_twins(Topology& t) {
  number_edges(t);
  choose_outgoing(t);
}

Index max_valence(const Topology& topology) {
  std::vector<Index> degree(static_cast<std::size_t>(topology.vertex_count), 0);
  for (std::size_t h = 0; h < topology.twin.size(); ++h) {
    ++degree[static_cast<std::size_t>(topology.origin(static_cast<Index>(h)))];
    if (topology.twin[h] < 0) ++degree[static_cast<std::size_t>(topology.target(static_cast<Index>(h)))];
  }
  return degree.empty() ? 0 : *std::max_element(degree.begin(), degree.end());
}

}  // namespace pelage
