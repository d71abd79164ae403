#include "shape/relief.h"

#include "base/parallel.h"
#include "shape/normals.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

void add(Point& sum, double factor, const Point& v) {
  for (std::size_t d = 0; d < 3; ++d) sum[d] += factor * v[d];
}

}  // namespace

std::vector<Point> surface_gradients(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                                     const std::vector<double>& values) {
  std::vector<Point> gradients(points.size(), Point{});
  std::vector<double> areas(points.size(), 0.0);
  for (const Triangle& t : triangles) {
    const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(t[k % 3]); };
    const Point n =
        cross(difference(points[corner(1)], points[corner(0)]), difference(points[corner(2)], points[corner(0)]));
    const double area = length(n);
    if (!(area > 0)) continue;
    Point along{};  // turned by a right angle: the sum of values times opposite edges
    for (std::size_t k = 0; k < 3; ++k)
      add(along, values[corner(k)], difference(points[corner(k + 2)], points[corner(k + 1)]));
    const Point weighted = cross(unit(n), along);  // gradient times area, both doubled
    for (std::size_t k = 0; k < 3; ++k) {
      add(gradients[corner(k)], 1, weighted);
      areas[corner(k)] += area;
    }
  }
  for (std::size_t v = 0; v < gradients.size(); ++v)
    if (areas[v] > 0)
      gradients[v] = {gradients[v][0] / areas[v], gradients[v][1] / areas[v], gradients[v][2] / areas[v]};
  return gradients;
}

std::vector<Point> relief_normals(const TriangleMesh& mesh, const std::vector<Point>& normals,
                                  const std::vector<double>& height) {
  std::vector<Point> result = surface_gradients(mesh.triangles, mesh.points, height);
  parallel_for(result.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const double off = dot(result[v], normals[v]);
      Point n = normals[v];
      add(n, -1, result[v]);
      add(n, off, normals[v]);
      result[v] = unit(n);
    }
  });
  return result;
}

TriangleMesh raised(TriangleMesh mesh, const std::vector<double>& height) {
  const std::vector<Point> normals = normals_of(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) add(mesh.points[v], height[v], normals[v]);
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& n : vertex_normals(mesh.triangles, mesh.points))
    normal.values.insert(normal.values.end(), n.begin(), n.end());
  mesh.set(std::move(normal));
  return mesh;
}

}  // namespace pelage
