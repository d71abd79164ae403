#include "shape/creases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Point face_normal(const Topology& t, const std::vector<Point>& points, Index face) {
  const auto [a, b, c] = t.triangles[at(face)];
  return cross(difference(points[at(b)], points[at(a)]), difference(points[at(c)], points[at(a)]));
}

bool turns(const Point& a, const Point& b, double cosine) { return dot(a, b) < cosine * length(a) * length(b); }

}  // namespace

Creases creases_above(double degrees, const Topology& t, const std::vector<Point>& points) {
  const double cosine = std::cos(degrees * std::numbers::pi / 180);
  Topology creased = t;
  creased.creases = {std::vector<char>(at(t.edge_count), 0), std::vector<char>(at(t.vertex_count), 0)};
  bool any = false;
  for (std::size_t h = 0; h < t.twin.size(); ++h) {
    const Index g = t.twin[h];
    if (g < static_cast<Index>(h)) continue;
    const Point one = face_normal(t, points, static_cast<Index>(h / 3)), two = face_normal(t, points, g / 3);
    if (!turns(one, two, cosine)) continue;
    creased.creases.edge[at(t.edge[h])] = true;
    any = true;
  }
  if (!any) return {};
  VertexRing v;
  for (Index i = 0; i < t.vertex_count; ++i) {
    vertex_ring(creased, i, v);
    const auto to = [&](std::size_t k) { return points[at(v.ring[v.sharp[k]])]; };
    creased.creases.corner[at(i)] =
        v.sharp.size() > 2 ||
        (v.sharp.size() == 2 && turns(difference(points[at(i)], to(0)), difference(to(1), points[at(i)]), cosine));
  }
  return creased.creases;
}

Creases split_creases(const Topology& coarse, const Topology& fine) {
  if (!coarse.creases.any()) return {};
  Creases result{std::vector<char>(at(fine.edge_count), 0), coarse.creases.corner};
  result.corner.resize(at(fine.vertex_count), 0);
  for (std::size_t h = 0; h < coarse.twin.size(); ++h) {
    if (!coarse.creases.edge[at(coarse.edge[h])]) continue;
    // Child k of a triangle is at its corner k; the side from there and the one that ends there keep their numbers.
    const std::size_t face = h / 3, k = h % 3, next = (k + 1) % 3;
    for (const std::size_t child : {k, next}) result.edge[at(fine.edge[3 * (4 * face + child) + k])] = true;
  }
  return result;
}

void vertex_ring(const Topology& t, Index vertex, VertexRing& result) {
  result.ring.clear();
  result.sharp.clear();
  result.corner = t.creases.any() && t.creases.corner[at(vertex)];
  const Index start = t.outgoing[at(vertex)];
  result.closed = start >= 0 && t.twin[at(start)] >= 0;
  for (Index h = start; h >= 0;) {
    if (t.sharp(h)) result.sharp.push_back(result.ring.size());
    result.ring.push_back(t.target(h));
    const Index following = t.rotate(h);
    if (following < 0) {
      result.sharp.push_back(result.ring.size());
      result.ring.push_back(t.origin(previous_halfedge(h)));
    }
    if (following == start) break;
    h = following;
  }
}

std::vector<Index> sector(const VertexRing& v, std::size_t i) {
  if (v.sharp.size() < 2) return v.ring;
  const std::size_t n = v.ring.size(), first = v.sharp[i],
                    last = i + 1 < v.sharp.size() ? v.sharp[i + 1] : v.sharp[0] + n;
  std::vector<Index> part;
  for (std::size_t k = first; k <= last; ++k) part.push_back(v.ring[k % n]);
  return part;
}

std::size_t sector_count(const VertexRing& v) { return v.sharp.size() < 2 ? 1 : v.sharp.size() - (v.closed ? 0 : 1); }

CutMesh cut_at_creases(const Topology& t) {
  CutMesh cut{t.triangles, std::vector<Index>(at(t.vertex_count))};
  std::iota(cut.vertex.begin(), cut.vertex.end(), 0);
  VertexRing around;
  for (Index v = 0; t.creases.any() && v < t.vertex_count; ++v) {
    vertex_ring(t, v, around);
    for (std::size_t i = 1; i < sector_count(around); ++i) {
      const std::vector<Index> part = sector(around, i);
      Index h = t.outgoing[at(v)];
      while (t.target(h) != part.front()) h = t.rotate(h);
      for (std::size_t k = 0; k + 1 < part.size(); ++k, h = t.rotate(h))
        cut.triangles[at(h / 3)][at(h % 3)] = static_cast<Index>(cut.vertex.size());
      cut.vertex.push_back(v);
    }
  }
  return cut;
}

}  // namespace pelage
