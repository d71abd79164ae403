#include "shape/normals.h"

#include "shape/vectors.h"

namespace pelage {

std::vector<Point> vertex_normals(const std::vector<Triangle>& triangles, const std::vector<Point>& points) {
  std::vector<Point> normals(points.size(), Point{});
  for (const Triangle& t : triangles) {
    const Point& a = points[static_cast<std::size_t>(t[0])];
    const Point n = cross(difference(points[static_cast<std::size_t>(t[1])], a),
                          difference(points[static_cast<std::size_t>(t[2])], a));
    for (std::int32_t v : t)
      for (std::size_t d = 0; d < 3; ++d) normals[static_cast<std::size_t>(v)][d] += n[d];
  }
  for (Point& n : normals) n = unit(n);
  return normals;
}

std::vector<Point> limit_normals(const LimitMasks& masks, const std::vector<Point>& control) {
  std::vector<Point> normals = combine(masks.tangent1, control);
  const std::vector<Point> other = combine(masks.tangent2, control);
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit(cross(normals[i], other[i]));
  return normals;
}

}  // namespace pelage
