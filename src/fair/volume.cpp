#include "fair/volume.h"

#include "fair/faces.h"
#include "shape/normals.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Component number of every vertex, and whether the component has a boundary.
struct Components {
  std::vector<Index> of_vertex;
  std::vector<char> open;
};

Components find_components(const Topology& topology) {
  Components c{std::vector<Index>(topology.vertex_count, -1), {}};
  std::vector<Index> queue, ring;
  for (Index seed = 0; seed < topology.vertex_count; ++seed) {
    if (c.of_vertex[seed] >= 0) continue;
    const auto number = static_cast<Index>(c.open.size());
    c.open.push_back(0);
    c.of_vertex[seed] = number;
    queue = {seed};
    while (!queue.empty()) {
      const Index v = queue.back();
      queue.pop_back();
      if (topology.on_boundary(v)) c.open.back() = 1;  // also a vertex without triangles
      topology.one_ring(v, ring);
      for (Index w : ring) {
        if (c.of_vertex[w] >= 0) continue;
        c.of_vertex[w] = number;
        queue.push_back(w);
      }
    }
  }
  return c;
}

}  // namespace

ClosedParts::ClosedParts(const Topology& topology) : topology_(topology) {
  const Components components = find_components(topology);
  std::vector<Index> number;
  for (char open : components.open) number.push_back(open ? -1 : static_cast<Index>(count_++));
  for (Index c : components.of_vertex) part_.push_back(number[c]);
}

std::vector<double> ClosedParts::volumes(const std::vector<Point>& points) const {
  std::vector<double> volume(count_, 0.0);
  std::vector<Index> origin(count_, -1);  // nearby, so that far from 0 nothing cancels
  for (const Triangle& t : topology_.triangles) {
    const Index part = part_[t[0]];
    if (part < 0) continue;
    if (origin[part] < 0) origin[part] = t[0];
    const Point& o = points[origin[part]];
    volume[part] +=
        dot(difference(points[t[0]], o), cross(difference(points[t[1]], o), difference(points[t[2]], o))) / 6;
  }
  return volume;
}

std::vector<double> ClosedParts::areas(const std::vector<Point>& points) const {
  std::vector<double> area(count_, 0.0);
  for (const Triangle& t : topology_.triangles)
    if (part_[t[0]] >= 0)
      area[part_[t[0]]] +=
          length(cross(difference(points[t[1]], points[t[0]]), difference(points[t[2]], points[t[0]]))) / 2;
  return area;
}

double ClosedParts::volume(const std::vector<Point>& points) const {
  double sum = 0;
  for (double v : volumes(points)) sum += v;
  return sum;
}

void ClosedParts::restore_volumes(const std::vector<Point>& before, std::vector<Point>& points) const {
  const std::vector<double> wanted = volumes(before);
  constexpr int rounds = 3;  // Newton's method on a function that is nearly linear
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> present = volumes(points), area = areas(points);
    const std::vector<Point> normal = vertex_normals(topology_.triangles, points);
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Index part = part_[v];
      if (part < 0 || !(area[part] > 0)) continue;
      const double way = (wanted[part] - present[part]) / area[part];
      for (std::size_t k = 0; k < 3; ++k) points[v][k] += way * normal[v][k];
    }
  }
}

}  // namespace pelage
