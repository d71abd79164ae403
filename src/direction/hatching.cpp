#include "direction/hatching.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/checked.h"
#include "base/random.h"
#include "shape/generators.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Point plus(const Point& a, double s, const Point& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }

// Linear light: unglazed clay, ink, and two signal colours that stay apart in print and for the colour-blind.
constexpr Point clay{0.62, 0.58, 0.52}, ink{0.035, 0.03, 0.03}, red{0.70, 0.07, 0.03}, blue{0.03, 0.16, 0.55};

/// A place on the surface: in a triangle, by barycentric coordinates.
struct Place {
  Index face = -1;
  std::array<double, 3> weight{};
};

class Tracer {
 public:
  Tracer(const TriangleMesh& mesh, const Connection& c, const DirectionField& field)
      : mesh_(mesh), c_(c), field_(field) {}

  Point position(const Place& p) const { return blend(p, mesh_.points); }
  Point normal(const Place& p) const { return unit(blend(p, c_.normal)); }

  /// Of the field's directions, with lines counted both ways, the one nearest to `like`.
  Point direction(const Place& p, const Point& like) const {
    Point sum{};
    for (std::size_t k = 0; k < 3; ++k) sum = plus(sum, p.weight[k], nearest(mesh_.triangles[at(p.face)][k], like));
    const Point n = face_normal(p.face);
    return unit(plus(sum, -dot(sum, n), n));
  }

  /// Places along the field from `start`, up to `length` away or to the boundary.
  std::vector<Place> trace(Place start, Point heading, double length) const {
    std::vector<Place> path{start};
    for (int step = 0; step < most_faces && length > 0; ++step) {
      heading = direction(start, heading);
      const std::optional<double> walked = walk(start, heading, length);
      path.push_back(start);
      if (!walked) break;
      length -= *walked;
    }
    return path;
  }

 private:
  static constexpr int most_faces = 400;

  Point blend(const Place& p, const std::vector<Point>& values) const {
    Point sum{};
    for (std::size_t k = 0; k < 3; ++k) sum = plus(sum, p.weight[k], values[at(mesh_.triangles[at(p.face)][k])]);
    return sum;
  }

  Point face_normal(Index f) const {
    const Triangle& t = mesh_.triangles[at(f)];
    return unit(cross(difference(mesh_.points[at(t[1])], mesh_.points[at(t[0])]),
                      difference(mesh_.points[at(t[2])], mesh_.points[at(t[0])])));
  }

  Point nearest(Index v, const Point& like) const {
    const int ways = field_.n == 4 ? 4 : 2;
    Point best{};
    double most = -2;
    for (int k = 0; k < ways; ++k) {
      const Point d = c_.tangent(v, field_.angle[at(v)] + 2 * std::numbers::pi * k / ways);
      if (dot(d, like) <= most) continue;
      most = dot(d, like);
      best = d;
    }
    return best;
  }

  /// Change of the barycentric coordinates per unit of length.
  std::array<double, 3> slope(Index f, const Point& heading) const {
    const Triangle& t = mesh_.triangles[at(f)];
    const Point a = mesh_.points[at(t[0])], u = difference(mesh_.points[at(t[1])], a),
                v = difference(mesh_.points[at(t[2])], a);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
    if (!(det > 0)) return {0, 0, 0};
    const double hu = dot(heading, u), hv = dot(heading, v);
    const double b = (vv * hu - uv * hv) / det, c = (uu * hv - uv * hu) / det;
    return {-b - c, b, c};
  }

  /// Straight on to the end of the triangle or of the length, and over the edge; the distance, or nothing at the
  /// boundary.
  std::optional<double> walk(Place& p, const Point& heading, double length) const {
    const std::array<double, 3> s = slope(p.face, heading);
    std::size_t out = 3;
    double distance = length;
    for (std::size_t k = 0; k < 3; ++k)
      if (s[k] < 0 && p.weight[k] / -s[k] < distance) {
        distance = p.weight[k] / -s[k];
        out = k;
      }
    for (std::size_t k = 0; k < 3; ++k) p.weight[k] = std::max(0.0, p.weight[k] + distance * s[k]);
    if (out < 3 && !cross_edge(p, out)) return std::nullopt;
    return distance;
  }

  /// Over the edge opposite of corner `out`.
  bool cross_edge(Place& p, std::size_t out) const {
    const Index h = 3 * p.face + static_cast<Index>((out + 1) % 3), twin = c_.topology.twin[at(h)];
    if (twin < 0) return false;
    const double at_start = p.weight[(out + 1) % 3], at_end = p.weight[(out + 2) % 3], sum = at_start + at_end;
    if (!(sum > 0)) return false;
    p = {twin / 3, {}};
    p.weight[at(twin % 3)] = at_end / sum;
    p.weight[at((twin + 1) % 3)] = at_start / sum;
    return true;
  }

  const TriangleMesh& mesh_;
  const Connection& c_;
  const DirectionField& field_;
};

struct Box {
  Point low{}, high{};
};

Box box_around(const std::vector<Point>& points) {
  if (points.empty()) return {};
  Box box{points[0], points[0]};
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], p[k]);
      box.high[k] = std::max(box.high[k], p[k]);
    }
  return box;
}

/// Places no two of which are nearer than `spacing`: darts, thrown evenly over the area, that keep their distance.
std::vector<Place> scattered(const TriangleMesh& mesh, const Connection& c, double spacing) {
  std::vector<double> sum{0};
  for (const Triangle& t : mesh.triangles)
    sum.push_back(sum.back() + length(cross(difference(mesh.points[at(t[1])], mesh.points[at(t[0])]),
                                            difference(mesh.points[at(t[2])], mesh.points[at(t[0])]))) /
                                   2);
  const auto darts = static_cast<std::uint64_t>(std::min(2e6, 12 * sum.back() / (spacing * spacing)));
  const DirectionField none;
  const Tracer tracer(mesh, c, none);
  const Box box = box_around(mesh.points);
  const double edge = std::max(spacing, length(difference(box.high, box.low)) / 1e6);  // cells have numbers of 32 bits
  std::map<std::array<int, 3>, std::vector<Point>> cells;
  const auto cell_of = [&](const Point& p) {
    std::array<int, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) cell[k] = saturated<int>(std::floor((p[k] - box.low[k]) / edge));
    return cell;
  };
  const auto is_free = [&](const Point& p) {
    const auto [x, y, z] = cell_of(p);
    for (int i = 0; i < 27; ++i)
      if (const auto found = cells.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1}); found != cells.end())
        for (const Point& other : found->second)
          if (length(difference(p, other)) < spacing) return false;
    return true;
  };
  std::vector<Place> places;
  for (std::uint64_t k = 0; k < darts; ++k) {
    const auto f = std::upper_bound(sum.begin(), sum.end(), uniform(3, 3 * k) * sum.back()) - sum.begin() - 1;
    const double r = std::sqrt(uniform(3, 3 * k + 1)), s = uniform(3, 3 * k + 2);
    const Place place{static_cast<Index>(std::min(f, std::ssize(mesh.triangles) - 1)), {1 - r, r * (1 - s), r * s}};
    const Point p = tracer.position(place);
    if (!is_free(p)) continue;
    cells[cell_of(p)].push_back(p);
    places.push_back(place);
  }
  return places;
}

/// Gathers the drawing.
class Drawing {
 public:
  explicit Drawing(const TriangleMesh& mesh, const Connection& c) {
    result_.points = mesh.points;
    result_.triangles = mesh.triangles;
    normal_ = c.normal;
    color_.assign(mesh.points.size(), clay);
  }

  Index vertex(const Point& p, const Point& normal, const Point& color) {
    result_.points.push_back(p);
    normal_.push_back(normal);
    color_.push_back(color);
    return static_cast<Index>(result_.points.size()) - 1;
  }
  void triangle(Index a, Index b, Index c) { result_.triangles.push_back({a, b, c}); }

  void ball(const TriangleMesh& sphere, const Point& centre, double radius, const Point& color) {
    const auto first = static_cast<Index>(result_.points.size());
    for (const Point& p : sphere.points) vertex(plus(centre, radius, p), p, color);
    for (const Triangle& t : sphere.triangles) triangle(first + t[0], first + t[1], first + t[2]);
  }

  TriangleMesh finish() {
    result_.set({"normal", 3, Domain::vertex, flat(normal_)});
    result_.set({"color", 3, Domain::vertex, flat(color_)});
    return std::move(result_);
  }

 private:
  static std::vector<double> flat(const std::vector<Point>& points) {
    std::vector<double> values;
    for (const Point& p : points) values.insert(values.end(), p.begin(), p.end());
    return values;
  }
  TriangleMesh result_;
  std::vector<Point> normal_, color_;
};

/// Half the width of a ribbon at a share of its length.
double half_width(int n, double share) {
  return n == 1 ? 1.3 * (1 - share) : std::sqrt(std::max(0.0, 4 * share * (1 - share)));
}

void draw_ribbon(Drawing& drawing, const Tracer& tracer, const std::vector<Place>& path, int n, double width) {
  std::vector<Point> points;
  std::vector<double> way{0};
  for (const Place& p : path) {
    points.push_back(tracer.position(p));
    if (points.size() > 1) way.push_back(way.back() + length(difference(points.back(), points[points.size() - 2])));
  }
  if (!(way.back() > 0)) return;
  Index left = -1, right = -1;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point normal = tracer.normal(path[i]);
    const Point ahead = difference(points[std::min(i + 1, path.size() - 1)], points[i > 0 ? i - 1 : 0]);
    const Point side = unit(cross(normal, ahead));
    const Point lifted = plus(points[i], width / 2, normal);  // off the triangles, which bend away below
    const double half = width / 2 * half_width(n, way[i] / way.back());
    const Index l = drawing.vertex(plus(lifted, half, side), normal, ink);
    const Index r = drawing.vertex(plus(lifted, -half, side), normal, ink);
    if (left >= 0) {
      drawing.triangle(right, r, l);
      drawing.triangle(right, l, left);
    }
    left = l;
    right = r;
  }
}

/// The whole stroke around a place, from its tail to its head.
std::vector<Place> stroke(const Tracer& tracer, const Place& middle, const Point& heading, double length) {
  std::vector<Place> back = tracer.trace(middle, plus({}, -1, heading), length / 2);
  const std::vector<Place> front = tracer.trace(middle, heading, length / 2);
  std::reverse(back.begin(), back.end());
  back.insert(back.end(), front.begin() + 1, front.end());
  return back;
}

}  // namespace

TriangleMesh hatched(const TriangleMesh& mesh, const Connection& c, const DirectionField& field,
                     const HatchingOptions& options) {
  Drawing drawing(mesh, c);
  const Box box = box_around(mesh.points);
  const double spacing = options.spacing > 0 ? options.spacing : length(difference(box.high, box.low)) / 50;
  const Tracer tracer(mesh, c, field);
  if (!(spacing > 0)) return drawing.finish();
  for (const Place& place : scattered(mesh, c, spacing)) {
    const Index v = mesh.triangles[at(place.face)][0];
    const Point heading = field.direction[at(v)];
    draw_ribbon(drawing, tracer, stroke(tracer, place, heading, 2.2 * spacing), field.n, 0.16 * spacing);
    if (field.n == 4)
      draw_ribbon(drawing, tracer, stroke(tracer, place, cross(c.normal[at(v)], heading), 2.2 * spacing), field.n,
                  0.16 * spacing);
  }
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=162");
  for (Index f = 0; f < std::ssize(field.index); ++f)
    if (const int index = field.index[at(f)]; index != 0)
      drawing.ball(sphere, tracer.position({f, {1. / 3, 1. / 3, 1. / 3}}), 0.35 * spacing, index > 0 ? red : blue);
  return drawing.finish();
}

}  // namespace pelage
