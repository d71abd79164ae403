#include "fair/vertex_update.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace pelage {

namespace {

/// A face leans away from its normal when the cosine of the angle is below this (70 degrees).
constexpr double leaning = 0.3;
/// A triangle has become a needle when its shape is below the first and below this share of what it was.
constexpr double needle_shape = 0.1, needle_share = 0.5;
/// Share of the way to the mean of the neighbours: less than all of it, lest neighbours swap places.
constexpr double relaxation = 0.5;

Point moved(const Point& p, const Vector3& by) { return {p[0] + by[0], p[1] + by[1], p[2] + by[2]}; }

/// Four sqrt(3) times the area over the sum of the squared sides: 1 for an equilateral triangle, 0 without area.
double shape(const Triangle& t, const std::vector<Point>& points) {
  const Vector3 a = vector3(points[t[0]]), b = vector3(points[t[1]]), c = vector3(points[t[2]]);
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares : 0;
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

Unfolding::Unfolding(const Topology& topology, const std::vector<Point>& points) : topology_(topology) {
  for (const Triangle& t : topology.triangles) first_shape_.push_back(shape(t, points));
}

std::vector<char> Unfolding::marked_vertices(const FaceGeometry& faces, const std::vector<Vector3>& normal,
                                             const std::vector<Point>& points) const {
  std::vector<char> marked(topology_.vertex_count, 0);
  for (std::size_t f = 0; f < normal.size(); ++f) {
    const Triangle& t = topology_.triangles[f];
    const double limit = std::min(needle_shape, needle_share * first_shape_[f]);
    if (faces.normal[f].dot(normal[f]) < leaning || shape(t, points) < limit)
      for (Index v : t) marked[v] = 1;
  }
  return marked;
}

std::size_t Unfolding::apply(const FaceLists& faces_of_vertex, const std::vector<Vector3>& normal,
                             const std::vector<char>& fixed, int rounds, std::vector<Point>& points) const {
  std::size_t count = 0;
  for (int round = 0; round < rounds; ++round) {
    const FaceGeometry faces = face_geometry(topology_.triangles, points);
    const std::vector<char> marked = marked_vertices(faces, normal, points);
    std::vector<Point> next = points;
    count = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (!marked[v] || fixed[v]) continue;
      ++count;
      next[v] = moved(points[v], relaxation * tangential_step(topology_, faces_of_vertex[v], faces.area, normal, points,
                                                              static_cast<Index>(v)));
    }
    if (count == 0) break;
    points = std::move(next);
  }
  return count;
}

}  // namespace pelage
