#pragma once
// Parallel transport between the vertices of a triangle mesh.
//
// Directions at a vertex are angles in its polar coordinates: the angles of the triangles around an interior vertex are
// scaled to add up to 2 pi, counted counter-clockwise from its first outgoing halfedge (Knoeppel, Crane, Pinkall,
// Schroeder 2013, section 6; Polthier, Schmies 1998). At the boundary they keep their size.

#include <vector>

#include "direction/tangent_planes.h"
#include "pelage/point.h"
#include "shape/topology.h"

namespace pelage {

/// Areas of its vertices are thirds of those of their triangles; `east` of a vertex is its angle 0.
struct Connection : TangentPlanes {
  Topology topology;
  std::vector<double> corner;     ///< per halfedge: scaled angle at its origin within its triangle [rad]
  std::vector<double> transport;  ///< per halfedge: angle at its target of a direction parallel to angle 0 [rad]
  std::vector<double> cotangent;  ///< per halfedge: half the cotangent of the opposite angle

  /// Total turn of a direction carried once around a triangle [rad]. The sum over a closed mesh is 2 pi times its
  /// Euler characteristic.
  double curvature(Index face) const;
};

Connection make_connection(Topology topology, const std::vector<Point>& points);

}  // namespace pelage
