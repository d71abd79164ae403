#include "direction/guides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "base/number.h"
#include "discretise/curvature.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Point combination(double s, const Point& a, double t, const Point& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

Point in_sense(const TangentPlanes& c, Index v, const Point& direction, Sense sense) {
  return sense == Sense::along ? direction : cross(c.normal[at(v)], direction);
}

/// Of those that have an area, and so a tangent plane.
Index nearest_place(const TangentPlanes& planes, const std::vector<Point>& points, const Point& place) {
  Index best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index v = 0; v < planes.places(); ++v) {
    const Point d = difference(points[at(v)], place);
    if (!(planes.area[at(v)] > 0) || !(dot(d, d) < nearest)) continue;
    nearest = dot(d, d);
    best = v;
  }
  return best;
}

double mean_edge(const Connection& c, const std::vector<Point>& points) {
  double sum = 0;
  for (Index h = 0; h < std::ssize(c.corner); ++h)
    sum += length(difference(points[at(c.topology.target(h))], points[at(c.topology.origin(h))]));
  return c.corner.empty() ? 0 : sum / static_cast<double>(c.corner.size());
}

/// The direction of the larger eigenvalue of a tensor's tangential part, and the difference of the two.
struct Principal {
  Point direction;
  double difference;
};

Principal principal(const TangentPlanes& c, Index v, const Tensor& t) {
  const auto times = [&](const Point& a) {
    return Point{t[0] * a[0] + t[1] * a[1] + t[2] * a[2], t[1] * a[0] + t[3] * a[1] + t[4] * a[2],
                 t[2] * a[0] + t[4] * a[1] + t[5] * a[2]};
  };
  const Point &e = c.east[at(v)], &n = c.north[at(v)];
  const double ee = dot(e, times(e)), en = dot(e, times(n)), nn = dot(n, times(n));
  return {c.tangent(v, std::atan2(2 * en, ee - nn) / 2), std::hypot(ee - nn, 2 * en)};
}

/// The Laplacian of links with the marked rows replaced, symmetrically, by those of a unit matrix.
class MarkedLaplacian {
 public:
  MarkedLaplacian(Index places, const std::map<Index, double>& marks)
      : marks_(marks), rows_(at(places)), right_(Vector::Zero(places)) {}

  void add(const PlaneLink& l) {
    add(l.from, l.to, l.weight);
    add(l.to, l.from, l.weight);
  }

  Vector solve() {
    for (const auto& [v, value] : marks_) {
      rows_[at(v)] = {{v, 1}};
      right_[v] = value;
    }
    for (Index v = 0; v < std::ssize(rows_); ++v) rows_[at(v)].try_emplace(v, 0);
    return solve_spd(matrix(), right_, {.tolerance = 1e-12, .max_iterations = 100000});
  }

 private:
  void add(Index row, Index column, double weight) {
    rows_[at(row)][row] += weight;
    if (const auto mark = marks_.find(column); mark != marks_.end())
      right_[row] += weight * mark->second;
    else
      rows_[at(row)][column] -= weight;
  }
  /// A trace of the diagonal keeps pieces without marks, where any constant solves, at 0.
  SparseMatrix matrix() const {
    constexpr double trace = 1e-12;
    auto pattern = std::make_shared<SparsePattern>();
    SparseMatrix a;
    pattern->rows = pattern->columns = static_cast<Index>(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (const auto& [j, value] : rows_[i]) {
        pattern->column.push_back(j);
        a.value.push_back(at(j) == i ? value * (1 + trace) + (value == 0 ? 1 : 0) : value);
      }
      pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
    }
    a.pattern = std::move(pattern);
    return a;
  }

  const std::map<Index, double>& marks_;
  std::vector<std::map<Index, double>> rows_;
  Vector right_;
};

/// The gradient of a linear function on a triangle, times twice the triangle's area.
Point scaled_gradient(const Triangle& t, const std::vector<Point>& points, const std::vector<double>& f) {
  const Point normal =
      unit(cross(difference(points[at(t[1])], points[at(t[0])]), difference(points[at(t[2])], points[at(t[0])])));
  Point sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point opposite = difference(points[at(t[(k + 2) % 3])], points[at(t[(k + 1) % 3])]);
    sum = combination(1, sum, f[at(t[k])], cross(normal, opposite));
  }
  return sum;
}

}  // namespace

void require_marks(Index vertices, const std::vector<Index>& low, const std::vector<Index>& high) {
  if (low.empty() || high.empty()) throw Error(Fault::usage, "mark at least one vertex at each end");
  for (const auto* list : {&low, &high})
    for (const Index v : *list)
      if (v < 0 || v >= vertices)
        throw Error(Fault::usage, "vertex " + std::to_string(v) + " is marked; the mesh has " +
                                      std::to_string(vertices) + ", counted from 0");
  const std::set<Index> of_high(high.begin(), high.end());
  for (const Index v : low)
    if (of_high.contains(v)) throw Error(Fault::usage, "vertex " + std::to_string(v) + " is marked for both ends");
}

/// Half edges of the mesh from a point of a stroke to the next; from end to end a shape has some thousands.
constexpr double most_halves = 2e5;

std::vector<Guide> stroke_guides(const TangentPlanes& planes, const std::vector<Point>& points, double edge,
                                 const std::vector<Point>& stroke) {
  std::map<Index, Point> direction;
  const double step = edge / 2;
  for (std::size_t k = 0; k + 1 < stroke.size(); ++k) {
    const Point d = difference(stroke[k + 1], stroke[k]);
    const double halves = length(d) / std::max(step, 1e-300);
    if (!(halves <= most_halves))
      throw Error(Fault::usage, "a stroke is more than " + number(most_halves / 2) +
                                    " edges of the mesh long; give its points in the coordinates of the shape");
    const int parts = std::max(1, static_cast<int>(halves));
    for (int i = 0; i <= parts && length(d) > 0; ++i) {
      Point& sum = direction[nearest_place(planes, points, combination(1, stroke[k], double(i) / parts, d))];
      sum = combination(1, sum, 1, unit(d));
    }
  }
  if (direction.empty()) throw Error(Fault::usage, "a stroke needs two different points");
  std::vector<Guide> guides;
  for (const auto& [v, d] : direction)
    if (v >= 0) guides.push_back({v, d, std::numeric_limits<double>::infinity()});
  return guides;
}

namespace {

/// Weighted by how far the direction, of length 1, is tangent.
Guide tangential_guide(const TangentPlanes& c, Index v, const Point& direction, double weight, Sense sense) {
  const double out = dot(direction, c.normal[at(v)]);
  return {v, in_sense(c, v, direction, sense), weight * std::max(0.0, 1 - out * out)};
}

}  // namespace

std::vector<Guide> axis_guides(const TangentPlanes& c, const Point& axis, double weight, Sense sense) {
  if (!(length(axis) > 0)) throw Error(Fault::usage, "the axis has no direction; give a vector other than 0,0,0");
  std::vector<Guide> guides;
  for (Index v = 0; v < c.places(); ++v) guides.push_back(tangential_guide(c, v, unit(axis), weight, sense));
  return guides;
}

std::vector<Guide> centre_guides(const TangentPlanes& c, const std::vector<Point>& points, const Point& centre,
                                 double weight, Sense sense) {
  std::vector<Guide> guides;
  for (Index v = 0; v < c.places(); ++v)
    if (const Point away = difference(points[at(v)], centre); length(away) > 0)
      guides.push_back(tangential_guide(c, v, unit(away), weight, sense));
  return guides;
}

std::vector<Guide> curvature_guides(const TangentPlanes& c, const std::vector<Tensor>& curvature, double strength,
                                    Sense sense) {
  std::vector<Guide> guides;
  for (Index v = 0; v < c.places(); ++v) {
    const Principal p = principal(c, v, curvature[at(v)]);
    guides.push_back({v, in_sense(c, v, p.direction, sense), strength * p.difference * p.difference});
  }
  return guides;
}

std::vector<double> harmonic_function(Index places, const std::vector<PlaneLink>& links, const std::vector<Index>& low,
                                      const std::vector<Index>& high) {
  require_marks(places, low, high);
  std::map<Index, double> marks;
  for (const Index v : low) marks[v] = 0;
  for (const Index v : high) marks[v] = 1;
  MarkedLaplacian laplacian(places, marks);
  for (const PlaneLink& l : links) laplacian.add(l);
  const Vector f = laplacian.solve();
  return {f.begin(), f.end()};
}

std::vector<double> harmonic_function(const Connection& c, const std::vector<Index>& low,
                                      const std::vector<Index>& high) {
  std::vector<PlaneLink> links;
  for (Index h = 0; h < std::ssize(c.corner); ++h)
    links.push_back({c.topology.origin(h), c.topology.target(h), c.cotangent[at(h)], c.transport[at(h)]});
  return harmonic_function(c.places(), links, low, high);
}

std::vector<Point> vertex_gradients(const Topology& topology, const std::vector<Point>& points,
                                    const std::vector<double>& function) {
  std::vector<Point> sum(points.size(), Point{});
  for (const Triangle& t : topology.triangles) {
    const Point g = scaled_gradient(t, points, function);
    for (const Index v : t) sum[at(v)] = combination(1, sum[at(v)], 1, g);
  }
  return sum;
}

std::vector<Guide> gradient_guides(const TangentPlanes& c, const std::vector<Point>& gradient, double weight,
                                   Sense sense) {
  std::vector<Guide> guides;
  for (Index v = 0; v < c.places(); ++v)
    if (length(gradient[at(v)]) > 0) guides.push_back({v, in_sense(c, v, gradient[at(v)], sense), weight});
  return guides;
}

std::vector<Guide> find_guides(const FieldWish& wish, const GuidedSurface& surface, double diagonal) {
  const TangentPlanes& planes = surface.planes;
  const double weight = 1 / (wish.smooth * wish.smooth);
  const Sense sense = wish.across ? Sense::across : Sense::along;
  std::vector<Guide> guides;
  const auto add = [&](const std::vector<Guide>& more) { guides.insert(guides.end(), more.begin(), more.end()); };
  if (wish.axis) add(axis_guides(planes, *wish.axis, weight, sense));
  if (wish.centre) add(centre_guides(planes, surface.points, *wish.centre, weight, sense));
  if (wish.curvature) {
    const double mean = diagonal / 4;  // a typical radius: its bends count with the full weight
    add(curvature_guides(planes, surface.curvature(), weight * mean * mean, sense));
  }
  if (!wish.from.empty() || !wish.to.empty())
    add(gradient_guides(planes, surface.way(wish.from, wish.to), weight, sense));
  for (const std::vector<Point>& stroke : wish.strokes)
    add(stroke_guides(planes, surface.points, surface.edge, stroke));
  return guides;
}

std::vector<Guide> find_guides(const FieldWish& wish, const Connection& c, const std::vector<Point>& points,
                               double diagonal) {
  const GuidedSurface surface{.planes = c,
                              .points = points,
                              .edge = mean_edge(c, points),
                              .curvature = [&] { return vertex_curvature(loop_discretisation(c.topology), points); },
                              .way =
                                  [&](const std::vector<Index>& low, const std::vector<Index>& high) {
                                    return vertex_gradients(c.topology, points, harmonic_function(c, low, high));
                                  }};
  return find_guides(wish, surface, diagonal);
}

}  // namespace pelage
