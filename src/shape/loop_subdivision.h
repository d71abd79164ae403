#pragma once
// Loop subdivision (Loop 1987): refinement of connectivity and control values, and the limit masks.
// Boundaries and creases (creases.h) are cubic B-splines of their own vertices, corners stay where they are: the rules
// of Hoppe et al. 1994 with the plain weights, as OpenSubdiv has them.

#include "shape/stencils.h"
#include "shape/topology.h"

namespace pelage {

/// One level of refinement: vertex v keeps its number, the new vertex on edge e gets number vertex_count + e.
/// Triangle f = (a, b, c) becomes 4f: (a, ab, ca), 4f+1: (ab, b, bc), 4f+2: (ca, bc, c), 4f+3: (bc, ca, ab).
struct Refinement {
  std::vector<Triangle> triangles;
  Stencils stencils;  ///< rows: refined vertices; columns: vertices of the coarse mesh
};

/// Loop's rules. The limit surface of the refined mesh is that of the coarse mesh.
Refinement loop_refine(const Topology& topology);

/// The triangles of the refined mesh.
std::vector<Triangle> split_triangles(const Topology& topology);

/// The same connectivity with midpoints on the edges: keeps the flat triangles.
Refinement midpoint_refine(const Topology& topology);

/// Weight beta of each neighbour in Loop's rule for an interior vertex of valence n:
/// v' = (1 - n beta) v + beta sum(neighbours).
double loop_beta(Index valence);

/// Limits at the control vertices.
struct LimitMasks {
  Stencils position;
  Stencils tangent1,
      tangent2;  ///< two independent tangents, tangent1 x tangent2 points outward; lengths have no meaning; on
                 ///< creases those of one side
};
LimitMasks loop_limit_masks(const Topology& topology);

/// What the position masks make of control values, and the unit normals that the tangents of control points have (0
/// where they are parallel; on creases the mean of their sides): without the memory of the masks.
std::vector<double> loop_limits(const Topology& topology, const std::vector<double>& control);
std::vector<Point> loop_limits(const Topology& topology, const std::vector<Point>& control);
std::vector<Point> loop_limit_normals(const Topology& topology, const std::vector<Point>& control);

/// The same for every side of a crease.
class CornerNormals {
 public:
  CornerNormals(const Topology& topology, const std::vector<Point>& control);
  /// At a corner of a triangle.
  const Point& at(std::size_t face, std::size_t corner) const {
    return normals_[static_cast<std::size_t>(triangles_[face][corner])];
  }

 private:
  std::vector<Triangle> triangles_;  ///< cut at creases
  std::vector<Point> normals_;
};

}  // namespace pelage
