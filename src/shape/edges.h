#pragma once
// Which triangles meet at which edge, in plain sorted arrays.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Half-edge 3*f + k runs from corner k of triangle f to the next corner of f.
using HalfEdge = std::int32_t;

inline HalfEdge next_in_face(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::int32_t tail(const std::vector<Triangle>& triangles, HalfEdge h) { return triangles[h / 3][h % 3]; }
inline std::int32_t tip(const std::vector<Triangle>& triangles, HalfEdge h) { return tail(triangles, next_in_face(h)); }

/// All half-edges, grouped by undirected edge. Edges come in the order of (smaller, larger vertex), the
/// half-edges of an edge in the order of their numbers.
class EdgeTable {
 public:
  /// Vertex numbers must lie in [0, vertex_count). Time and memory are linear in the number of triangles
  /// (but for sorting the edges around each vertex).
  EdgeTable(const std::vector<Triangle>& triangles, std::size_t vertex_count);

  std::size_t size() const { return first_.size() - 1; }
  /// The half-edges of edge e.
  std::span<const HalfEdge> operator[](std::size_t e) const {
    return {half_edges_.data() + first_[e], half_edges_.data() + first_[e + 1]};
  }

 private:
  std::vector<HalfEdge> half_edges_;
  std::vector<std::size_t> first_;
};

}  // namespace pelage
