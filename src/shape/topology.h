#pragma once
// Connectivity of an oriented manifold triangle mesh (with or without boundary), in flat arrays.
//
// Halfedge 3*f+k runs from corner k to corner k+1 of triangle f; the triangle lies to its left.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

using Index = std::int32_t;

inline Index next_halfedge(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline Index previous_halfedge(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Where a surface is not smooth. Both are empty where it is smooth everywhere.
struct Creases {
  std::vector<char> edge;    ///< per edge: whether it is sharp (edges of the boundary need not say it)
  std::vector<char> corner;  ///< per vertex: whether it stays where it is; those where three sharp edges meet, at least
  bool any() const { return !edge.empty(); }
  bool operator==(const Creases&) const = default;
};

struct Topology {
  Index vertex_count = 0;
  Index edge_count = 0;
  std::vector<Triangle> triangles;
  std::vector<Index> twin;      ///< per halfedge: the opposite halfedge, or -1 on the boundary
  std::vector<Index> edge;      ///< per halfedge: number of its undirected edge
  std::vector<Index> outgoing;  ///< per vertex: an outgoing halfedge; on the boundary the first one counter-clockwise
                                ///< (its twin is -1); -1 for a vertex without triangles
  Creases creases;

  Index origin(Index h) const { return triangles[static_cast<std::size_t>(h / 3)][static_cast<std::size_t>(h % 3)]; }
  Index target(Index h) const { return origin(next_halfedge(h)); }
  bool on_boundary(Index vertex) const {
    const Index h = outgoing[static_cast<std::size_t>(vertex)];
    return h < 0 || twin[static_cast<std::size_t>(h)] < 0;
  }
  /// Whether the surfaces on both sides of an edge meet at an angle, or it has one side only.
  bool sharp(Index h) const {
    return twin[static_cast<std::size_t>(h)] < 0 ||
           (creases.any() && creases.edge[static_cast<std::size_t>(edge[static_cast<std::size_t>(h)])]);
  }
  /// The outgoing halfedge that follows h counter-clockwise around its origin, or -1 at the end of an open fan.
  Index rotate(Index h) const { return twin[static_cast<std::size_t>(previous_halfedge(h))]; }
  /// Neighbours of a vertex, counter-clockwise; on the boundary from the first to the last boundary neighbour.
  /// The result replaces the contents of `ring`.
  void one_ring(Index vertex, std::vector<Index>& ring) const;
};

/// Throws Error(Fault::input), naming the face, if an edge has more than two faces or two equally directed ones, or
/// if a vertex is non-manifold.
Topology make_topology(std::size_t vertex_count, std::vector<Triangle> triangles);

/// Fills edge, edge_count and outgoing from the rest, which must be a manifold: as make_topology does.
void number_from_twins(Topology& topology);

/// Largest number of edges at a vertex.
Index max_valence(const Topology& topology);

}  // namespace pelage
