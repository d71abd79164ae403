#pragma once
// Polygons that do not fit together.

#include <memory>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Adds the flat square a, a + e, a + e + f, a + f as n x n squares of two triangles with vertices of their own.
inline void add_square(TriangleMesh& mesh, const Point& a, const Point& e, const Point& f, int n = 1) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto first = static_cast<std::int32_t>(mesh.points.size());
      for (const auto& [u, v] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        Point p = a;
        for (std::size_t k = 0; k < 3; ++k) p[k] += (i + u) * e[k] / n + (j + v) * f[k] / n;
        mesh.points.push_back(p);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
}

/// The unit cube of six squares that share no vertex.
inline TriangleMesh six_squares() {
  TriangleMesh mesh;
  add_square(mesh, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  add_square(mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  add_square(mesh, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  add_square(mesh, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  add_square(mesh, {0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  add_square(mesh, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  return mesh;
}

/// The square from 0 to 2 in x and 0 to 1 in y: the half x < 1 in 3 x 3 parts, the other in 4 x 4, so that vertices of
/// either lie in the middle of the other's edges.
inline TriangleMesh square_with_t_junctions() {
  TriangleMesh mesh;
  add_square(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3);
  add_square(mesh, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4);
  return mesh;
}

inline std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

/// The vertices alone.
inline TriangleMesh cloud_of(TriangleMesh mesh) {
  mesh.triangles.clear();
  mesh.attributes.clear();
  return mesh;
}

}  // namespace pelage
