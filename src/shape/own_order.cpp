#include "shape/own_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box.h"
#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// No axis, diagonal or plane of symmetry of usual shapes is at a right angle to it.
constexpr Point direction = {0.8171, 0.4623, 0.3441};

/// The half-edges by which the triangles of a component are entered, from one on.
void walk(const Topology& t, Index start, std::vector<char>& seen, std::vector<Index>& entries) {
  std::size_t next = entries.size();
  const auto meet = [&](Index h) {
    if (h < 0 || seen[at(h / 3)]) return;
    seen[at(h / 3)] = true;
    entries.push_back(h);
  };
  meet(start);
  for (; next < entries.size(); ++next)
    for (Index h = entries[next], k = 0; k < 3; ++k, h = next_halfedge(h)) meet(t.twin[at(h)]);
}

struct Component {
  Index vertex = -1;  ///< furthest in the direction
  double height = -std::numeric_limits<double>::infinity();
};

std::vector<Component> components(const Topology& t, const std::vector<Point>& points) {
  const Point middle = box_of(points).middle();
  std::vector<char> seen(t.triangles.size(), false);
  std::vector<Index> entries;
  std::vector<Component> list;
  for (Index f = 0; at(f) < t.triangles.size(); ++f) {
    if (seen[at(f)]) continue;
    const std::size_t before = entries.size();
    walk(t, 3 * f, seen, entries);
    Component c;
    for (std::size_t i = before; i < entries.size(); ++i)
      for (const Index v : t.triangles[at(entries[i] / 3)])
        if (const double height = dot(difference(points[at(v)], middle), direction); height > c.height) c = {v, height};
    list.push_back(c);
  }
  std::ranges::sort(list, {}, [](const Component& c) { return -c.height; });
  return list;
}

/// Those of triangles that begin with these half-edges, in their order.
std::vector<Index> renumbered_twins(const Topology& t, const std::vector<Index>& entries) {
  std::vector<Index> face(t.triangles.size());
  for (std::size_t i = 0; i < entries.size(); ++i) face[at(entries[i] / 3)] = static_cast<Index>(i);
  const auto renumbered = [&](Index h) {
    if (h < 0) return h;
    const Index own = face[at(h / 3)];
    return 3 * own + (h - entries[at(own)] + 3) % 3;  // both half-edges are of one triangle
  };
  std::vector<Index> twin(t.twin.size());
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (Index k = 0, h = entries[i]; k < 3; ++k, h = next_halfedge(h)) twin[3 * i + at(k)] = renumbered(t.twin[at(h)]);
  return twin;
}

/// The creases of triangles that begin with these half-edges, with these vertices of `t`.
Creases renumbered_creases(const Topology& t, const std::vector<Index>& entries, const std::vector<Index>& vertex,
                           const Topology& own) {
  if (!t.creases.any()) return {};
  Creases result{std::vector<char>(at(own.edge_count), 0), std::vector<char>(vertex.size())};
  for (std::size_t v = 0; v < vertex.size(); ++v) result.corner[v] = t.creases.corner[at(vertex[v])];
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (Index k = 0, h = entries[i]; k < 3; ++k, h = next_halfedge(h))
      result.edge[at(own.edge[3 * i + at(k)])] = t.creases.edge[at(t.edge[at(h)])];
  return result;
}

}  // namespace

Index first_halfedge(const Topology& t, const std::vector<Point>& points, Index vertex) {
  const Index start = t.outgoing[at(vertex)];
  Index best = start;
  double most = -std::numeric_limits<double>::infinity();
  for (Index h = start; h >= 0 && t.twin[at(start)] >= 0;) {
    const double height = dot(difference(points[at(t.target(h))], points[at(vertex)]), direction);
    if (height > most) most = height, best = h;
    h = t.rotate(h);
    if (h == start) break;
  }
  return best;
}

MeshPlace own_place(const Topology& t, const std::vector<Point>& points, MeshPlace p) {
  constexpr double rounding = 1e-7;
  const double u = 1 - p.v - p.w;
  const bool on_edge[] = {p.w < rounding, u < rounding, p.v < rounding};  // in the order of the half-edges
  const Index first = 3 * p.face;
  for (Index k = 0; k < 3; ++k)
    if (on_edge[k] && on_edge[(k + 2) % 3]) return place_on(first_halfedge(t, points, t.origin(first + k)), 0);
  for (Index k = 0; k < 3; ++k) {
    if (!on_edge[k]) continue;
    const Index h = first + k, twin = t.twin[at(h)];
    const double along = k == 0 ? p.v : k == 1 ? p.w : u;
    if (twin < 0) return place_on(h, along);
    const Index here = t.origin(previous_halfedge(h)), there = t.origin(previous_halfedge(twin));
    const bool stays = dot(difference(points[at(here)], points[at(there)]), direction) > 0;
    return stays ? place_on(h, along) : place_on(twin, 1 - along);
  }
  return p;
}

OwnOrder own_order(const Topology& t, const std::vector<Point>& points) {
  std::vector<char> seen(t.triangles.size(), false);
  std::vector<Index> entries, number(at(t.vertex_count), -1);
  entries.reserve(t.triangles.size());
  for (const Component& c : components(t, points)) walk(t, first_halfedge(t, points, c.vertex), seen, entries);
  OwnOrder order;
  order.vertex.reserve(number.size());
  const auto renumbered = [&](Index v) {
    if (number[at(v)] < 0) {
      number[at(v)] = static_cast<Index>(order.vertex.size());
      order.vertex.push_back(v);
    }
    return number[at(v)];
  };
  Topology& own = order.topology;
  own.vertex_count = t.vertex_count;
  own.triangles.reserve(entries.size());
  for (const Index h : entries) {
    const Index next = next_halfedge(h);
    const Index a = renumbered(t.origin(h)), b = renumbered(t.origin(next)), c = renumbered(t.target(next));
    own.triangles.push_back({a, b, c});
  }
  for (Index v = 0; v < t.vertex_count; ++v) renumbered(v);
  own.twin = renumbered_twins(t, entries);
  number_from_twins(own);
  own.creases = renumbered_creases(t, entries, order.vertex, own);
  return order;
}

std::vector<Point> without_symmetry(const std::vector<Point>& points, double edge) {
  // Waves a few edges long in directions without common measure.
  constexpr double size = 5e-6;
  constexpr Point wave[3] = {{1.618, 0.723, 1.137}, {0.871, 1.414, 0.577}, {1.272, 0.915, 1.732}};
  const Point middle = box_of(points).middle();
  std::vector<Point> moved(points.size());
  parallel_for(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point p = difference(points[i], middle);
      for (std::size_t k = 0; k < 3; ++k)
        moved[i][k] = points[i][k] + size * edge * std::sin(dot(p, wave[k]) / edge + static_cast<double>(k + 1));
    }
  });
  return moved;
}

}  // namespace pelage
