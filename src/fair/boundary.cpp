#include "fair/boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fair/faces.h"

namespace pelage {

namespace {

/// The same angle that makes an edge of a surface sharp (fair/compare.h).
const double least_cosine = std::cos(35 * std::numbers::pi / 180);

Point as_point(const Vector3& v) { return {v[0], v[1], v[2]}; }

Vector3 nearest_on_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double square = (b - a).squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0;
  return a + t * (b - a);
}

}  // namespace

BoundaryRails::BoundaryRails(const Topology& topology, const std::vector<Point>& points)
    : corner_(topology.vertex_count, 0) {
  std::vector<Index> before(topology.vertex_count, -1), after = before;
  for (Index h = 0; h < static_cast<Index>(topology.twin.size()); ++h) {
    if (topology.twin[h] >= 0) continue;
    after[topology.origin(h)] = topology.target(h);
    before[topology.target(h)] = topology.origin(h);
  }
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (before[v] < 0 || after[v] < 0) continue;
    const Vector3 a = vector3(points[before[v]]), b = vector3(points[v]), c = vector3(points[after[v]]);
    corner_[v] = !((b - a).dot(c - b) >= least_cosine * (b - a).norm() * (c - b).norm());
    rails_.push_back({v, as_point((a + b) / 2), points[v], as_point((b + c) / 2)});
  }
}

void BoundaryRails::put_back(std::vector<Point>& points) const {
  for (const Rail& r : rails_) {
    const Vector3 p = vector3(points[r.vertex]);
    const Vector3 one = nearest_on_segment(p, vector3(r.from), vector3(r.at));
    const Vector3 other = nearest_on_segment(p, vector3(r.at), vector3(r.to));
    points[r.vertex] = as_point((one - p).squaredNorm() <= (other - p).squaredNorm() ? one : other);
  }
}

std::vector<char> boundary_vertices(const Topology& topology) {
  std::vector<char> on_boundary(topology.vertex_count);
  for (Index v = 0; v < topology.vertex_count; ++v) on_boundary[v] = topology.on_boundary(v);
  return on_boundary;
}

}  // namespace pelage
