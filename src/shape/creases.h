#pragma once
// Sharp creases of subdivision surfaces (Hoppe et al. 1994, "Piecewise smooth surface reconstruction"): for each of its
// two sides a crease is what a boundary is, a cubic B-spline of its own vertices.

#include "shape/topology.h"

namespace pelage {

/// The edges where two triangles meet at more than so many degrees (0: in one plane), and as corners the vertices where
/// three of them or of the boundary meet, or where the line of two turns by more than as many degrees. Without such
/// edges there are no creases, corners of the boundary neither.
Creases creases_above(double degrees, const Topology& topology, const std::vector<Point>& points);

/// Those of the mesh whose triangles are split into four (split_triangles): the halves of sharp edges are sharp.
Creases split_creases(const Topology& coarse, const Topology& fine);

/// A vertex and its neighbours, as Topology::one_ring has them.
struct VertexRing {
  std::vector<Index> ring;
  std::vector<std::size_t> sharp;  ///< ranks of those to which sharp edges lead, ascending
  bool closed = false;             ///< all around the vertex
  bool corner = false;
};
void vertex_ring(const Topology& topology, Index vertex, VertexRing& result);

/// The neighbours of a vertex within one of the sectors into which sharp edges part its triangles, counter-clockwise:
/// the one that begins with sharp[i]. With fewer than two sharp edges all of them, once around.
std::vector<Index> sector(const VertexRing& vertex, std::size_t i);
/// How many there are.
std::size_t sector_count(const VertexRing& vertex);

/// The triangles of a mesh with a vertex for every side of a crease.
struct CutMesh {
  std::vector<Triangle> triangles;
  std::vector<Index> vertex;  ///< which vertex of the mesh each is; the first are themselves
};
CutMesh cut_at_creases(const Topology& topology);

}  // namespace pelage
