#include "fair/vertex_update.h"

#include "base/parallel.h"

namespace pelage {

namespace {

/// A face leans away from its normal when the cosine of the angle is below this (70 degrees).
constexpr double leaning = 0.3;
/// Share of the way to the mean of the neighbours: less than all of it, lest neighbours swap places.
constexpr double relaxation = 0.5;

Point moved(const Point& p, const Vector3& by) { return {p[0] + by[0], p[1] + by[1], p[2] + by[2]}; }

std::vector<char> leaning_vertices(const Topology& topology, const FaceGeometry& faces,
                                   const std::vector<Vector3>& normal) {
  std::vector<char> marked(topology.vertex_count, 0);
  for (std::size_t f = 0; f < normal.size(); ++f)
    if (faces.normal[f].dot(normal[f]) < leaning)
      for (Index v : topology.triangles[f]) marked[v] = 1;
  return marked;
}

/// From a vertex to the mean of its neighbours, without the part along the normal.
Vector3 tangential_step(const Topology& topology, std::span<const Index> faces, const std::vector<double>& area,
                        const std::vector<Vector3>& normal, const std::vector<Point>& points, Index v) {
  Vector3 sum = Vector3::Zero(), n = Vector3::Zero();
  int count = 0;
  for (Index f : faces) {
    n += area[f] * normal[f];
    for (Index w : topology.triangles[f])
      if (w != v) {
        sum += vector3(points[w]);
        ++count;
      }
  }
  const Vector3 step = sum / count - vector3(points[v]);
  return n.norm() > 0 ? Vector3(step - n * (n.dot(step) / n.squaredNorm())) : step;
}

}  // namespace

void follow_normals(const Topology& topology, const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                    const std::vector<char>& fixed, int rounds, std::vector<Point>& points) {
  std::vector<Point> next = points;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Vector3> centroid = face_geometry(topology.triangles, points).centroid;
    parallel_for(points.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto faces = faces_of_vertex[v];
        if (fixed[v] || faces.empty()) continue;
        Vector3 step = Vector3::Zero();
        for (Index f : faces) step += normal[f] * normal[f].dot(centroid[f] - vector3(points[v]));
        next[v] = moved(points[v], step / static_cast<double>(faces.size()));
      }
    });
    points = next;
  }
}

std::size_t unfold(const Topology& topology, const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                   const std::vector<char>& fixed, int rounds, std::vector<Point>& points) {
  std::size_t count = 0;
  for (int round = 0; round < rounds; ++round) {
    const FaceGeometry faces = face_geometry(topology.triangles, points);
    const std::vector<char> marked = leaning_vertices(topology, faces, normal);
    std::vector<Point> next = points;
    count = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (!marked[v] || fixed[v]) continue;
      ++count;
      next[v] = moved(points[v], relaxation * tangential_step(topology, faces_of_vertex[v], faces.area, normal, points,
                                                              static_cast<Index>(v)));
    }
    if (count == 0) break;
    points = std::move(next);
  }
  return count;
}

}  // namespace pelage
