#pragma once
// Places on the flat triangles of a mesh.

#include "shape/topology.h"

namespace pelage {

/// The point (1 - v - w) a + v b + w c of triangle `face` = (a, b, c).
struct MeshPlace {
  Index face = -1;
  double v = 0, w = 0;
  bool operator==(const MeshPlace&) const = default;
};

/// The place at a fraction of the way along a half-edge, 0 at its origin.
inline MeshPlace place_on(Index halfedge, double along) {
  switch (halfedge % 3) {
    case 0:
      return {halfedge / 3, along, 0};
    case 1:
      return {halfedge / 3, 1 - along, along};
    default:
      return {halfedge / 3, 0, 1 - along};
  }
}

/// The fraction of a place that lies on a half-edge.
inline double fraction_on(Index halfedge, const MeshPlace& place) {
  return halfedge % 3 == 0 ? place.v : halfedge % 3 == 1 ? place.w : 1 - place.w;
}

/// Values at vertices, linear between: T needs sums and products with numbers.
template <class T>
T value_at(const std::vector<Triangle>& triangles, const std::vector<T>& values, const MeshPlace& place) {
  const Triangle& t = triangles[static_cast<std::size_t>(place.face)];
  const auto at = [&](int k) { return values[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
  return (1 - place.v - place.w) * at(0) + place.v * at(1) + place.w * at(2);
}

inline Point point_at(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                      const MeshPlace& place) {
  const Triangle& t = triangles[static_cast<std::size_t>(place.face)];
  const auto at = [&](int k, std::size_t d) {
    return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])][d];
  };
  Point p;
  for (std::size_t d = 0; d < 3; ++d)
    p[d] = (1 - place.v - place.w) * at(0, d) + place.v * at(1, d) + place.w * at(2, d);
  return p;
}

}  // namespace pelage
