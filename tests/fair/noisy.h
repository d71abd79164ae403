#pragma once
// Shapes with noise on them, the same on every machine.

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "fair/faces.h"
#include "shape/generators.h"
#include "shape/normals.h"

namespace pelage::testing {

inline double gaussian(std::uint64_t key, std::uint64_t counter) {
  return std::sqrt(-2 * std::log(1 - uniform(key, 2 * counter))) *
         std::cos(2 * std::numbers::pi * uniform(key, 2 * counter + 1));
}

inline double mean_edge(const TriangleMesh& mesh) {
  return pelage::mean_edge(make_topology(mesh.points.size(), mesh.triangles), mesh.points);
}

/// Gaussian noise along the normals, of a standard deviation in mean edges.
inline TriangleMesh with_noise(TriangleMesh mesh, double sigma, std::uint64_t seed = 1) {
  const double h = mean_edge(mesh);
  const std::vector<Point> normal = vertex_normals(mesh.triangles, mesh.points);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) mesh.points[v][k] += sigma * h * gaussian(seed, v) * normal[v][k];
  return mesh;
}

/// Gaussian noise in all directions.
inline TriangleMesh with_noise_everywhere(TriangleMesh mesh, double sigma, std::uint64_t seed = 1) {
  const double h = mean_edge(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) mesh.points[v][k] += sigma * h * gaussian(seed + k, v);
  return mesh;
}

}  // namespace pelage::testing
