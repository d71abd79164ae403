#include "shape/normals.h"

#include <cmath>

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
  return mesh.triangles.empty() ? normals_of(mesh) : vertex_normals(mesh.triangles, mesh.points);
}

std::vector<Point> normals_of(const TriangleMesh& mesh) {
  const Attribute* given = mesh.find("normal");
  if (!given || given->components != 3 || given->domain != Domain::vertex)
    return vertex_normals(mesh.triangles, mesh.points);
  std::vector<Point> normals(mesh.points.size());
  for (std::size_t v = 0; v < normals.size(); ++v)
    normals[v] = unit({given->values[3 * v], given->values[3 * v + 1], given->values[3 * v + 2]});
  return normals;
}

namespace {

/// The triangles around each vertex, one vertex after the other.
struct TrianglesAround {
  std::vector<std::size_t> first;  ///< per vertex + 1
  std::vector<std::size_t> triangle;

  TrianglesAround(const std::vector<Triangle>& triangles, std::size_t vertices)
      : first(vertices + 1), triangle(3 * triangles.size()) {
    for (const Triangle& t : triangles)
      for (const std::int32_t v : t) ++first[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (const std::int32_t v : triangles[t]) triangle[next[static_cast<std::size_t>(v)]++] = t;
  }
};

}  // namespace

Attribute corner_normals(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                         std::span<const std::uint8_t> side) {
  static const double crease = std::cos(40 * std::acos(-1.0) / 180);
  const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
  std::vector<Point> face;
  for (const auto& [a, b, c] : triangles) face.push_back(cross(difference(at(b), at(a)), difference(at(c), at(a))));
  const TrianglesAround around(triangles, points.size());
  Attribute normal{"normal", 3, Domain::corner, {}};
  normal.values.reserve(9 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::int32_t v : triangles[t]) {
      Point sum{};
      for (std::size_t k = around.first[static_cast<std::size_t>(v)]; k < around.first[static_cast<std::size_t>(v) + 1];
           ++k) {
        const std::size_t its = around.triangle[k];
        const Point& other = face[its];
        if ((side.empty() || side[its] == side[t]) && dot(other, face[t]) >= crease * length(other) * length(face[t]))
          for (std::size_t d = 0; d < 3; ++d) sum[d] += other[d];
      }
      const Point n =
          length(sum) > 0 ? unit(sum) : Point{0, 0, 1};  // of triangles without an area any direction serves
      normal.values.insert(normal.values.end(), n.begin(), n.end());
    }
  return normal;
}

}  // namespace pelage
