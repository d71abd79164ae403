#pragma once
// Parallel transport between the vertices of a triangle mesh.
//
// Directions at a vertex are angles in its polar coordinates: the angles of the triangles around an interior vertex are
// scaled to add up to 2 pi, counted counter-clockwise from its first outgoing halfedge (Knoeppel, Crane, Pinkall,
// Schroeder 2013, section 6; Polthier, Schmies 1998). At the boundary they keep their size.

#include <vector>

#include "pelage/point.h"
#include "shape/topology.h"

namespace pelage {

struct Connection {
  Topology topology;
  std::vector<double> corner;      ///< per halfedge: scaled angle at its origin within its triangle [rad]
  std::vector<double> transport;   ///< per halfedge: angle at its target of a direction parallel to angle 0 [rad]
  std::vector<double> cotangent;   ///< per halfedge: half the cotangent of the opposite angle
  std::vector<double> area;        ///< per vertex: a third of its triangles [world^2]
  std::vector<Point> normal;       ///< per vertex, unit length
  std::vector<Point> east, north;  ///< per vertex: unit tangents at the angles 0 and pi/2

  /// The unit tangent at an angle [rad].
  Point tangent(Index vertex, double angle) const;
  /// The angle of a vector's tangential part [rad]; 0 for a normal vector.
  double angle(Index vertex, const Point& vector) const;
  /// Total turn of a direction carried once around a triangle [rad]. The sum over a closed mesh is 2 pi times its
  /// Euler characteristic.
  double curvature(Index face) const;
};

Connection make_connection(Topology topology, const std::vector<Point>& points);

}  // namespace pelage
