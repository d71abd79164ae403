#pragma once
// Planar Voronoi cells of points among their neighbours in the tangent plane.

#include <array>
#include <cstdint>
#include <vector>

#include "pelage/cells.h"
#include "shape/cell_neighbours.h"

namespace pelage {

using PlanePoint = std::array<double, 2>;

/// A convex polygon around the origin, counter-clockwise; side k runs from corner k to the next one.
struct PlaneCell {
  /// What lies behind a side.
  struct Beyond {
    std::int32_t cell = -1;  ///< -1: none
    double distance = 0;     ///< to its point
  };
  std::vector<PlanePoint> corner;
  std::vector<Beyond> beyond;  ///< per side

  /// Keeps the part where x . q <= limit, behind which lies `what`. Nothing is left where the origin lies beyond.
  void clip(const PlanePoint& q, double limit, const Beyond& what);
  double area() const;
  double side_length(std::size_t k) const;
  double furthest_square() const;  ///< of a corner from the origin
};

/// Two unit vectors that make a right-handed frame with a unit normal.
struct TangentFrame {
  explicit TangentFrame(const Point& normal);
  PlanePoint in(const Point& v) const { return {dot(v, e), dot(v, f)}; }
  Point out(const PlanePoint& p) const {
    return {p[0] * e[0] + p[1] * f[0], p[0] * e[1] + p[1] * f[1], p[0] * e[2] + p[1] * f[2]};
  }
  Point e, f;
};

/// A neighbour in the plane of a cell.
struct PlaneNeighbour {
  std::int32_t cell;
  PlanePoint at;
  double square;  ///< of its distance
};

/// The Voronoi cell of the origin among its neighbours, which are sorted by their distance; at most `reach` wide to any
/// side.
PlaneCell voronoi_cell(std::vector<PlaneNeighbour>& neighbours, double reach);

}  // namespace pelage
