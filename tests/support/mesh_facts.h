#pragma once
// Counts and bounds that tests of meshes assert.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shape/topology.h"

namespace pelage::testing {

inline Eigen::Vector3d vec(const Point& p) { return Eigen::Vector3d(p.data()); }

struct MeshFacts {
  int euler = 0;       ///< vertices - edges + faces
  bool closed = true;  ///< no boundary edge
  double volume = 0;   ///< signed: positive when oriented outward
  double area = 0;
  double smallest_angle = 180;  ///< degrees
  double shortest_edge = 1e300, longest_edge = 0;
  std::vector<int> valences;  ///< per vertex: number of triangles
};

/// Throws, through make_topology, when the mesh is not an oriented manifold.
inline MeshFacts mesh_facts(const TriangleMesh& mesh) {
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  MeshFacts facts;
  facts.euler = static_cast<int>(mesh.points.size()) - topology.edge_count + static_cast<int>(mesh.triangles.size());
  facts.closed = std::count(topology.twin.begin(), topology.twin.end(), -1) == 0;
  facts.valences.assign(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    facts.volume += vec(mesh.points[t[0]]).dot(vec(mesh.points[t[1]]).cross(vec(mesh.points[t[2]]))) / 6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = vec(mesh.points[t[k]]);
      const Eigen::Vector3d b = vec(mesh.points[t[(k + 1) % 3]]) - a, c = vec(mesh.points[t[(k + 2) % 3]]) - a;
      const double angle = std::atan2(b.cross(c).norm(), b.dot(c)) * 180 / std::numbers::pi;
      facts.smallest_angle = std::min(facts.smallest_angle, angle);
      facts.shortest_edge = std::min(facts.shortest_edge, b.norm());
      facts.longest_edge = std::max(facts.longest_edge, b.norm());
      facts.area += b.cross(c).norm() / 6;
      ++facts.valences[t[k]];
    }
  }
  return facts;
}

}  // namespace pelage::testing
