#pragma once
// Lengths of edges, and values on triangles that are split at the midpoints of their edges.

#include "shape/loop_subdivision.h"
#include "shape/mesh_place.h"

namespace pelage {

/// A length that 95 % of the surface, by area, does not exceed as the longest edge of its triangle.
double prevailing_edge(const std::vector<Triangle>& triangles, const std::vector<Point>& points);

// When every triangle is split into four at the midpoints of its edges, vertices keep their numbers and the midpoint of
// edge e gets the number vertex_count + e.

// Triangle f = (a, b, c) becomes 4 f: (a, ab, ca), 4 f + 1: (ab, b, bc), 4 f + 2: (ca, bc, c), 4 f + 3: (bc, ca, ab).

/// The same place on the finer mesh, and on the coarser one.
MeshPlace in_child(const MeshPlace& place);
MeshPlace in_parent(const MeshPlace& place);

/// Values at the vertices, `components` for each, linear over the triangles of `coarse`.
std::vector<double> split_values(const Topology& coarse, const std::vector<double>& values, std::size_t components = 1);
std::vector<Point> split_points(const Topology& coarse, const std::vector<Point>& points);
/// Corners likewise; the four parts of a triangle have its values.
void split_attribute(const Topology& coarse, Attribute& attribute);

/// The mesh so split, with all attributes.
TriangleMesh split_at_midpoints(const TriangleMesh& mesh);

}  // namespace pelage
