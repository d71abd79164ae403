#include "direction/connection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/normals.h"
#include "shape/own_order.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using std::numbers::pi;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Sine and cosine, times the lengths, of the angle between two edges of a triangle.
struct Turn {
  double sine, cosine;
};

/// At the origin of a halfedge.
Turn corner_turn(const Topology& t, const std::vector<Point>& points, Index h) {
  const Point& o = points[at(t.origin(h))];
  const Point a = difference(points[at(t.target(h))], o);
  const Point b = difference(points[at(t.origin(previous_halfedge(h)))], o);
  return {length(cross(a, b)), dot(a, b)};
}

/// A needle's cotangent is cut off here; beyond it says nothing about the surface.
constexpr double largest_cotangent = 100;

void measure_triangles(Connection& c, const std::vector<Point>& points) {
  const std::size_t halfedges = 3 * c.topology.triangles.size();
  c.corner.resize(halfedges);
  c.cotangent.resize(halfedges);
  c.area.assign(at(c.topology.vertex_count), 0.0);
  for (Index h = 0; at(h) < halfedges; ++h) {
    const Turn turn = corner_turn(c.topology, points, h);
    c.corner[at(h)] = std::atan2(turn.sine, turn.cosine);
    c.cotangent[at(next_halfedge(h))] =
        turn.sine > 0 ? std::clamp(turn.cosine / turn.sine, -largest_cotangent, largest_cotangent) / 2 : 0;
    c.area[at(c.topology.origin(h))] += turn.sine / 6;
  }
}

/// Polar angles of all outgoing halfedges; scales `corner`.
std::vector<double> polar_angles(Connection& c) {
  const Topology& t = c.topology;
  std::vector<double> polar(3 * t.triangles.size(), 0.0);
  for (Index v = 0; v < t.vertex_count; ++v) {
    const Index first = t.outgoing[at(v)];
    if (first < 0) continue;
    double sum = 0;
    Index h = first;
    do {
      polar[at(h)] = sum;
      sum += c.corner[at(h)];
      h = t.rotate(h);
    } while (h >= 0 && h != first);
    if (t.on_boundary(v) || !(sum > 0)) continue;
    h = first;
    do {
      polar[at(h)] *= 2 * pi / sum;
      c.corner[at(h)] *= 2 * pi / sum;
      h = t.rotate(h);
    } while (h != first);
  }
  return polar;
}

/// The polar angle at its target of a halfedge's reverse, which on the boundary is no halfedge.
double reverse_angle(const Connection& c, const std::vector<double>& polar, Index h) {
  const Index next = next_halfedge(h);
  return polar[at(next)] + c.corner[at(next)];
}

void build_tangents(Connection& c, const std::vector<Point>& points) {
  c.normal = vertex_normals(c.topology.triangles, points);
  c.east.assign(c.normal.size(), Point{});
  c.north.assign(c.normal.size(), Point{});
  for (Index v = 0; v < c.topology.vertex_count; ++v) {
    const Index h = c.topology.outgoing[at(v)];
    if (h < 0) continue;
    const Point& n = c.normal[at(v)];
    const Point edge = difference(points[at(c.topology.target(h))], points[at(v)]);
    c.north[at(v)] = unit(cross(n, edge));
    c.east[at(v)] = cross(c.north[at(v)], n);
  }
}

}  // namespace

double Connection::curvature(Index f) const {
  return corner[at(3 * f)] + corner[at(3 * f + 1)] + corner[at(3 * f + 2)] - pi;
}

Connection make_connection(Topology topology, const std::vector<Point>& points) {
  Connection c;
  c.topology = std::move(topology);
  // Angles count from an edge that the form of the surface chooses.
  for (Index v = 0; v < c.topology.vertex_count; ++v)
    c.topology.outgoing[at(v)] = first_halfedge(c.topology, points, v);
  measure_triangles(c, points);
  const std::vector<double> polar = polar_angles(c);
  c.transport.resize(polar.size());
  for (Index h = 0; at(h) < polar.size(); ++h) c.transport[at(h)] = reverse_angle(c, polar, h) + pi - polar[at(h)];
  build_tangents(c, points);
  return c;
}

}  // namespace pelage
