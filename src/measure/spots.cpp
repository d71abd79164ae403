#include "measure/spots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

#include "measure/parts.h"
#include "shape/edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The connected parts, each with what is known of it.
struct Part {
  double area = 0;
  Point moment{};  ///< area times centroid
  std::int32_t centre = -1;
};

double area_of(const TriangleMesh& mesh, const Triangle& t) {
  return length(cross(difference(mesh.points[at(t[1])], mesh.points[at(t[0])]),
                      difference(mesh.points[at(t[2])], mesh.points[at(t[0])]))) /
         2;
}

/// Areas by vertices, a third of their triangles each.
std::vector<Part> parts_of(const TriangleMesh& mesh, const PartNumbers& numbers) {
  std::vector<Part> parts(numbers.count);
  for (const Triangle& t : mesh.triangles) {
    const double third = area_of(mesh, t) / 3;
    for (const std::int32_t v : t) {
      if (numbers.of[at(v)] < 0) continue;
      Part& part = parts[at(numbers.of[at(v)])];
      part.area += third;
      for (std::size_t d = 0; d < 3; ++d) part.moment[d] += third * mesh.points[at(v)][d];
    }
  }
  std::vector<double> least(parts.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < numbers.of.size(); ++v) {
    const std::int32_t p = numbers.of[v];
    if (p < 0 || !(parts[at(p)].area > 0)) continue;
    Point centroid = parts[at(p)].moment;
    for (double& x : centroid) x /= parts[at(p)].area;
    const double away = length(difference(centroid, mesh.points[v]));
    if (away < least[at(p)]) {
      least[at(p)] = away;
      parts[at(p)].centre = static_cast<std::int32_t>(v);
    }
  }
  std::erase_if(parts, [](const Part& p) { return p.centre < 0; });
  return parts;
}

/// The vertices at the other ends of edges, vertex by vertex.
struct Rings {
  explicit Rings(const TriangleMesh& mesh) : first(mesh.points.size() + 1, 0) {
    for (const Triangle& t : mesh.triangles)
      for (const std::int32_t v : t) first[at(v) + 1] += 2;
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    other.resize(first.back());
    std::vector<std::size_t> next = first;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t step : {1U, 2U}) other[next[at(t[k])]++] = t[(k + step) % 3];
  }
  std::vector<std::size_t> first;
  std::vector<std::int32_t> other;
};

/// Of every vertex the part whose cell it is in, -1 where none reaches.
std::vector<std::int32_t> cells(const TriangleMesh& mesh, const std::vector<Part>& parts) {
  struct Claim {
    double away;
    std::int32_t vertex, part;
    bool operator>(const Claim& o) const { return std::tie(away, vertex, part) > std::tie(o.away, o.vertex, o.part); }
  };
  std::vector<std::int32_t> owner(mesh.points.size(), -1);
  std::priority_queue<Claim, std::vector<Claim>, std::greater<>> claims;
  for (std::size_t p = 0; p < parts.size(); ++p) claims.push({0, parts[p].centre, static_cast<std::int32_t>(p)});
  const Rings rings(mesh);
  while (!claims.empty()) {
    const Claim c = claims.top();
    claims.pop();
    if (owner[at(c.vertex)] >= 0) continue;
    owner[at(c.vertex)] = c.part;
    const Point& centre = mesh.points[at(parts[at(c.part)].centre)];
    for (std::size_t i = rings.first[at(c.vertex)]; i < rings.first[at(c.vertex) + 1]; ++i)
      if (const std::int32_t v = rings.other[i]; owner[at(v)] < 0)
        claims.push({length(difference(mesh.points[at(v)], centre)), v, c.part});
  }
  return owner;
}

/// Per part, the number of triangles of the mesh in which it meets two others; -1 where its cell reaches the border.
std::vector<std::int64_t> neighbours_of(const TriangleMesh& mesh, const std::vector<std::int32_t>& owner,
                                        std::size_t count) {
  std::vector<std::int64_t> neighbours(count, 0);
  for (const Triangle& t : mesh.triangles) {
    const std::int32_t a = owner[at(t[0])], b = owner[at(t[1])], c = owner[at(t[2])];
    if (a < 0 || b < 0 || c < 0 || a == b || b == c || c == a) continue;
    for (const std::int32_t p : {a, b, c}) ++neighbours[at(p)];
  }
  const EdgeTable edges(mesh.triangles, mesh.points.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1)
      for (const std::int32_t v : {tail(mesh.triangles, edges[e][0]), tip(mesh.triangles, edges[e][0])})
        if (owner[at(v)] >= 0) neighbours[at(owner[at(v)])] = std::numeric_limits<std::int32_t>::min();
  return neighbours;
}

}  // namespace

double mean_nearest(std::span<const Point> places) {
  if (places.size() < 2) return 0;
  double sum = 0;
  for (const Point& p : places) {
    double least = std::numeric_limits<double>::infinity();
    for (const Point& q : places)
      if (&p != &q) least = std::min(least, length(difference(p, q)));
    sum += least;
  }
  return sum / static_cast<double>(places.size());
}

Spots find_spots(const TriangleMesh& mesh, const std::vector<double>& values, double level, bool above) {
  const std::vector<Part> parts = parts_of(mesh, connected_parts(mesh.triangles, values, level, above));
  Spots spots;
  spots.count = parts.size();
  if (parts.empty()) return spots;
  for (const Part& p : parts)
    spots.diameter += 2 * std::sqrt(p.area / std::numbers::pi) / static_cast<double>(parts.size());
  std::vector<Point> centres;
  for (const Part& p : parts) centres.push_back(mesh.points[at(p.centre)]);
  spots.nearest = mean_nearest(centres);
  for (const std::int64_t n : neighbours_of(mesh, cells(mesh, parts), parts.size()))
    if (n >= 0) ++spots.neighbours[static_cast<std::size_t>(n)];
  return spots;
}

}  // namespace pelage
