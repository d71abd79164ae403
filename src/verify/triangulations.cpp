#include "verify/triangulations.h"

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "shape/generators.h"
#include "shape/topology.h"

namespace pelage {

namespace {

using Vec = Eigen::Vector3d;

Point on_sphere(const Vec& v) {
  const Vec unit = v.normalized();
  return {unit.x(), unit.y(), unit.z()};
}

/// Dilation of the plane by k seen through the stereographic projection: conformal, lengths change by k at one pole
/// and by 1/k at the other.
void grade(TriangleMesh& mesh, double ratio) {
  const double k = std::sqrt(ratio), square = k * k;
  for (Point& p : mesh.points) {
    const double down = 1 + p[2], up = 1 - p[2];
    p = on_sphere({2 * k * p[0], 2 * k * p[1], down - square * up});
  }
}

/// Pulls the ends of edges that share no neighbours together, to a twelfth of their distance.
void make_slivers(TriangleMesh& mesh) {
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  std::vector<char> touched(mesh.points.size(), false);
  std::vector<Index> ring_a, ring_b;
  for (Index a = 0; a < topology.vertex_count; ++a) {
    topology.one_ring(a, ring_a);
    const Index b = ring_a.front();
    topology.one_ring(b, ring_b);
    if (touched[a] || touched[b]) continue;
    for (Index v : ring_a) touched[v] = true;
    for (Index v : ring_b) touched[v] = true;
    const Vec p(mesh.points[a].data()), q(mesh.points[b].data()), half = (q - p) / 2;
    mesh.points[a] = on_sphere(p + 11.0 / 12.0 * half);
    mesh.points[b] = on_sphere(q - 11.0 / 12.0 * half);
  }
}

}  // namespace

TriangleMesh unit_sphere(SphereTriangulation triangulation, int n) {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=" + std::to_string(n));
  if (triangulation == SphereTriangulation::graded) grade(mesh, 10);
  if (triangulation == SphereTriangulation::slivers) make_slivers(mesh);
  return mesh;
}

}  // namespace pelage
