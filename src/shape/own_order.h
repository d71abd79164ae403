#pragma once
// An order of a mesh that depends on its form alone: not on how a file numbers it, where it lies, or how large it is.

#include <vector>

#include "shape/mesh_place.h"

namespace pelage {

struct OwnOrder {
  Topology topology;          ///< the same triangles, each beginning with the corner from where it is reached
  std::vector<Index> vertex;  ///< per vertex of it: the vertex of the mesh
};

/// Every component is gone through from a vertex that lies furthest in one direction, triangle by triangle across the
/// edges; components follow each other along that direction. Geometry decides where to begin and nothing else. Vertices
/// without triangles come last.
OwnOrder own_order(const Topology& topology, const std::vector<Point>& points);

/// Of the half-edges at a vertex that one which leads furthest in the direction; -1 without triangles. On a boundary
/// the half-edge along it.
Index first_halfedge(const Topology& topology, const std::vector<Point>& points, Index vertex);

/// The same place; on an edge or at a vertex, to rounding, of that of its triangles which the form of the mesh chooses.
MeshPlace own_place(const Topology& topology, const std::vector<Point>& points, MeshPlace place);

/// The points, moved by less than a hundred-thousandth of `edge` in a way that depends on the form alone: what was
/// equal by symmetry is then different by much more than rounding, so that the same comparisons come out the same way
/// wherever the shape lies.
std::vector<Point> without_symmetry(const std::vector<Point>& points, double edge);

}  // namespace pelage
