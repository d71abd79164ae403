#include "run/space_lines.h"

#include <algorithm>
#include <cmath>

#include "base/box.h"
#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "linalg/harmonic.h"
#include "pelage/error.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double trace(const Tensor& t) { return t[0] + t[3] + t[5]; }

void add(double weight, const Tensor& t, Tensor& sum) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * t[k];
}

/// Of harmonic functions: directions need no more.
constexpr double tolerance = 1e-9;

/// Where tensors are 0, the harmonic ones between the others, whose traces they have.
void complete(const Space& space, std::vector<Tensor>& tensors) {
  Held held;
  for (const Tensor& t : tensors) held.push_back(trace(t) > 0 ? 1 : 0);
  if (std::ranges::count(held, 1) == std::ssize(held)) return;
  if (std::ranges::count(held, 1) == 0) {
    std::ranges::fill(tensors, line_tensor({1, 0, 0}));
    return;
  }
  const HarmonicFunctions harmonic(space.stiffness(), std::move(held));
  Vector u(space.unknowns());
  for (std::size_t k = 0; k < Tensor{}.size(); ++k) {
    for (Index i = 0; i < space.unknowns(); ++i) u[i] = tensors[at(i)][k];
    harmonic.complete(u, tolerance);
    for (Index i = 0; i < space.unknowns(); ++i) tensors[at(i)][k] = u[i];
  }
}

/// Of the harmonic function from one set of nodes to another.
std::vector<Point> gradients_between(const Space& space, const std::vector<Point>& nodes,
                                     const std::vector<Index>& from, const std::vector<Index>& to) {
  require_marks(space.unknowns(), from, to);
  Vector u = Vector::Constant(space.unknowns(), 0.5);
  Held held(nodes.size());
  for (const Index v : from) u[v] = 0, held[at(v)] = 1;
  for (const Index v : to) u[v] = 1, held[at(v)] = 1;
  HarmonicFunctions(space.stiffness(), std::move(held)).complete(u, tolerance);
  std::vector<Point> gradient(nodes.size());
  Vector coordinate(space.unknowns());
  for (std::size_t d = 0; d < 3; ++d) {
    for (Index i = 0; i < space.unknowns(); ++i) coordinate[i] = nodes[at(i)][d];
    const Vector along = space.gradient_product(SampleRule::vertices, u, coordinate);
    for (Index i = 0; i < space.unknowns(); ++i) gradient[at(i)][d] = along[i];
  }
  return gradient;
}

struct Segment {
  Point begin, along;  ///< a unit vector
  double length;
};

std::vector<Segment> segments_of(const std::vector<std::vector<Point>>& strokes) {
  std::vector<Segment> segments;
  for (const std::vector<Point>& stroke : strokes)
    for (std::size_t k = 1; k < stroke.size(); ++k)
      if (const Point way = difference(stroke[k], stroke[k - 1]); length(way) > 0)
        segments.push_back({stroke[k - 1], unit(way), length(way)});
  if (segments.empty() && !strokes.empty()) throw Error(Fault::usage, "a stroke needs two different points");
  return segments;
}

/// The integral of r^-4 over a segment, r the distance from a place, which counts as at least `nearest` from its line.
double nearness(const Segment& s, const Point& place, double nearest) {
  const Point way = difference(place, s.begin);
  const double from = -dot(way, s.along), to = from + s.length;
  const double h2 = std::max(dot(way, way) - from * from, nearest * nearest), h = std::sqrt(h2);
  const auto integral = [&](double x) { return (x / (h2 + x * x) + std::atan(x / h) / h) / (2 * h2); };
  return integral(to) - integral(from);
}

/// The nodes' own tensors, or 0, count as a stroke does that is `smooth` away.
void mix_with_strokes(const std::vector<Segment>& segments, const std::vector<Point>& nodes, double smooth,
                      std::vector<Tensor>& tensors) {
  const double nearest = 1e-4 * box_of(nodes).diagonal(), reach = std::max(smooth, nearest);
  parallel_for(nodes.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Tensor sum{};
      add(1 / (reach * reach * reach), tensors[v], sum);
      for (const Segment& s : segments) add(nearness(s, nodes[v], nearest), line_tensor(s.along), sum);
      tensors[v] = {};
      add(1 / trace(sum), sum, tensors[v]);
    }
  });
}

void require_spatial(const FieldWish& wish) {
  if (wish.curvature)
    throw Error(
        Fault::usage,
        "only surfaces have principal curvatures for directions to follow; in blocks and volumes take an axis, a "
        "centre, from and to, or strokes");
  if (wish.across && !wish.strokes.empty())
    throw Error(Fault::usage,
                "in blocks and volumes \"across\" makes planes of directions, and strokes are lines: leave one out");
}

/// At the centre itself any direction will do.
Point from_centre(const Point& place, const Point& centre) {
  const Point away = difference(place, centre);
  return length(away) > 0 ? away : Point{1, 0, 0};
}

}  // namespace

std::vector<Tensor> wished_in_space(const Space& space, const std::vector<Point>& nodes, const FieldWish& wish) {
  require_spatial(wish);
  const bool between = !wish.from.empty() || !wish.to.empty();
  const std::vector<Point> way =
      between ? gradients_between(space, nodes, wish.from, wish.to) : std::vector<Point>(nodes.size());
  const int wishes = (wish.axis ? 1 : 0) + (wish.centre ? 1 : 0) + (between ? 1 : 0);
  std::vector<Tensor> tensors(nodes.size());
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    const auto follow = [&](const Point& vector) {
      if (const Point d = unit(vector); length(d) > 0)
        add(1.0 / wishes, wish.across ? plane_tensor(d) : line_tensor(d), tensors[v]);
    };
    if (wish.axis) follow(*wish.axis);
    if (wish.centre) follow(from_centre(nodes[v], *wish.centre));
    if (between) follow(way[v]);
  }
  const std::vector<Segment> segments = segments_of(wish.strokes);
  if (!segments.empty())
    mix_with_strokes(segments, nodes, wish.smooth, tensors);
  else
    complete(space, tensors);
  return tensors;
}

std::vector<Tensor> given_in_space(const Space& space, const std::vector<Point>& vectors) {
  std::vector<Tensor> tensors;
  for (const Point& d : vectors) tensors.push_back(line_tensor(unit(d)));
  complete(space, tensors);
  return tensors;
}

}  // namespace pelage
