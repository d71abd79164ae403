#pragma once
// Refinement of a mesh until its edges are short enough.

#include "shape/loop_subdivision.h"

namespace pelage {

/// A length that 95 % of the surface, by area, does not exceed as the longest edge of its triangle.
double prevailing_edge(const std::vector<Triangle>& triangles, const std::vector<Point>& points);

/// A mesh and its refinements.
struct RefinedMesh {
  Topology topology;
  std::vector<Point> control;
  int levels = 0;
};

/// Subdivides until the prevailing edge is at most `edge`: by Loop's rules, which keep the limit surface, or at
/// midpoints, which keep the flat triangles. Error(Fault::input) when that needs more than `max_triangles`.
RefinedMesh refine_to_edge(RefinedMesh mesh, double edge, bool loop, std::size_t max_triangles);

/// One level.
RefinedMesh refine_once(const RefinedMesh& mesh, bool loop);

/// The values on the mesh that midpoint_refine() makes, linear over the triangles.
void refine_attribute(Attribute& attribute, const Refinement& midpoints);

/// Every triangle split into four at the midpoints of its edges, with all attributes.
TriangleMesh split_at_midpoints(const TriangleMesh& mesh);

}  // namespace pelage
