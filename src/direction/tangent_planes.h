#pragma once
// Where directions on a surface are given: tangent planes of its vertices or cells, and which of them are neighbours.

#include <vector>

#include "pelage/point.h"
#include "shape/topology.h"

namespace pelage {

struct TangentPlanes {
  std::vector<double> area;        ///< of each place's own part of the surface [world^2]
  std::vector<Point> normal;       ///< of unit length
  std::vector<Point> east, north;  ///< unit tangents at the angles 0 and pi/2

  Index places() const { return static_cast<Index>(area.size()); }
  /// The unit tangent at an angle [rad].
  Point tangent(Index place, double angle) const;
  /// The angle of a vector's tangential part [rad]; 0 for a normal vector.
  double angle(Index place, const Point& vector) const;
};

/// Two neighbours.
struct PlaneLink {
  Index from, to;
  double weight;     ///< of their difference in a Dirichlet energy, sum of weight (f_to - f_from)^2
  double transport;  ///< the angle at `to` of a direction parallel to the angle 0 at `from` [rad]
};

}  // namespace pelage
