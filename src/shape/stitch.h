#pragma once
// Which faces are neighbours, and vertices to match: copies of a vertex along a seam become one vertex, and a
// vertex where several sheets touch becomes one for each.

#include <cstdint>
#include <vector>

#include "shape/edges.h"
#include "shape/finding.h"
#include "shape/numbered_mesh.h"

namespace pelage {

/// For each vertex the smallest number of a vertex in exactly the same place. Only vertices on open edges
/// (edges with one face) are compared; every other one is alone. Closed surfaces that touch stay apart.
/// `edges` is the table of the mesh.
std::vector<std::int32_t> open_places(const TriangleMesh& mesh, const EdgeTable& edges);

/// The edges of the mesh with vertices of the same place taken as one.
EdgeTable edges_of_places(const TriangleMesh& mesh, const std::vector<std::int32_t>& place);

struct EdgePairs {
  std::vector<HalfEdge> opposite;  ///< per half-edge: the one across the edge, or -1 on the boundary
  bool crowded = false;            ///< three or more faces met somewhere
};

/// Finds the neighbours of all faces. Edges are the same if they join the same
/// vertices or, while they are open, the same places; the directions may disagree.
/// Four or more faces at an edge are paired into separate sheets where that is beyond doubt: as many of either
/// direction, and around the edge the inside and the outside of the solid alternate; sheets are joined around
/// the inside. Every other edge with three or more faces is a ShapeFault. Reports "touching-edges".
/// No triangle may have two corners of the same place.
/// `edges` is the table of edges_of_places.
EdgePairs pair_half_edges(const NumberedMesh& work, const std::vector<std::int32_t>& place, const EdgeTable& edges,
                          std::vector<Finding>& findings);

/// Gives every fan of faces (connected around a vertex through `pairs`) a vertex of its own. The fan keeps
/// the smallest of its old vertices; a vertex that several fans want goes to the first of them, the others get
/// copies behind the last vertex. Vertices that no fan keeps are removed. A vertex attribute whose values
/// differ along a seam becomes a corner attribute. Reports "seams" (merged) and "touching-vertices" (split).
/// Throws ShapeFault if more than two faces still share both vertices of an edge.
void renumber_by_fans(NumberedMesh& work, const EdgePairs& pairs, std::vector<Finding>& findings);

}  // namespace pelage
