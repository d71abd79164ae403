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

std::vector<Point> vertex_normals(const TriangleMesh& mesh) {
  const Attribute* given = mesh.triangles.empty() ? mesh.find("normal") : nullptr;
  std::vector<Point> normals = vertex_normals(mesh.triangles, mesh.points);
  if (!given || given->components != 3 || given->domain != Domain::vertex) return normals;
  for (std::size_t v = 0; v < normals.size(); ++v)
    normals[v] = unit({given->values[3 * v], given->values[3 * v + 1], given->values[3 * v + 2]});
  return normals;
}

}  // namespace pelage
