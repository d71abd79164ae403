#include "look/onto_mesh.h"

#include <algorithm>

#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

OntoMesh::OntoMesh(const TriangleMesh& mesh, const Tessellation& coat)
    : mesh_(mesh), coat_(coat.triangles, coat.samples.position) {}

MeshPlace OntoMesh::on_coat(const MeshPlace& place, Index near) const {
  const Triangle& t = mesh_.triangles[static_cast<std::size_t>(place.face)];
  const auto corner = [&](std::size_t k) -> const Point& { return mesh_.points[static_cast<std::size_t>(t[k])]; };
  const Point normal = cross(difference(corner(1), corner(0)), difference(corner(2), corner(0))),
              p = point_at(mesh_.triangles, mesh_.points, place);
  return coat_.search(Eigen::Vector3d(p.data()), Eigen::Vector3d(normal.data()), near);
}

FarTriangles OntoMesh::farther_than(double distance) const {
  constexpr double third = 1.0 / 3;
  constexpr std::array<std::array<double, 2>, 7> looked_at = {
      {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}, {third, third}}};
  std::vector<double> furthest(mesh_.triangles.size(), 0);
  parallel_for(
      furthest.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f)
          for (const auto& [v, w] : looked_at) {
            const MeshPlace place{static_cast<Index>(f), v, w};
            const Point p = point_at(mesh_.triangles, mesh_.points, place);
            furthest[f] = std::max(furthest[f], (coat_.point(on_coat(place)) - Eigen::Vector3d(p.data())).norm());
          }
      },
      256);
  FarTriangles far;
  for (std::size_t f = 0; f < furthest.size(); ++f) {
    far.furthest = std::max(far.furthest, furthest[f]);
    if (furthest[f] > distance && far.count++ == 0) far.first = static_cast<Index>(f);
  }
  return far;
}

}  // namespace pelage
