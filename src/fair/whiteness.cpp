#include "fair/whiteness.h"

#include "fair/faces.h"
#include "shape/normals.h"

namespace pelage {

double correlation_of_ways(const Topology& topology, const std::vector<char>& fixed, const std::vector<Point>& from,
                           const std::vector<Point>& points) {
  const std::vector<Point> normal = vertex_normals(topology.triangles, points);
  std::vector<double> way(points.size(), 0);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!fixed[v]) way[v] = vector3(normal[v]).dot(vector3(points[v]) - vector3(from[v]));
  double products = 0, squares = 0;
  std::vector<Index> ring;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (fixed[v]) continue;
    topology.one_ring(static_cast<Index>(v), ring);
    if (ring.empty()) continue;
    double sum = 0;
    for (const Index w : ring) sum += way[w];
    products += way[v] * sum / static_cast<double>(ring.size());
    squares += way[v] * way[v];
  }
  return squares > 0 ? products / squares : 0;
}

double correlation_of_noise(int steps) { return -0.9 / (steps + 2.8); }

double growth_of_noise(int steps) { return correlation_of_noise(steps) - correlation_of_noise(steps - 1); }

}  // namespace pelage
