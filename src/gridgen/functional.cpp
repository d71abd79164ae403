#include "gridgen/functional.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Of smoothness, whatever is asked for: it keeps cells from folding, and is hardly seen elsewhere.
constexpr double least_smoothness = 0.01;

void add(double a, const Point& p, Point& sum) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += a * p[k];
}

std::array<Point, 4> corner_points(const Sheet& sheet, std::size_t cell, const std::vector<Point>& x) {
  const auto v = sheet.corners(cell);
  return {x[v[0]], x[v[1]], x[v[2]], x[v[3]]};
}

/// Derivatives by the edges as derivatives by the corners.
void add_edges(const CellEdges& by, std::array<Point, 4>& g) {
  add(1, by.south, g[1]), add(-1, by.south, g[0]);
  add(1, by.east, g[2]), add(-1, by.east, g[1]);
  add(1, by.north, g[2]), add(-1, by.north, g[3]);
  add(1, by.west, g[3]), add(-1, by.west, g[0]);
}

/// The sum over all cells of cell(number, gradient by its corners), divided by their number; adds to the gradient by
/// the nodes, cell after cell.
template <class Cell>
double cell_mean(const Sheet& sheet, std::vector<Point>& gradient, Cell&& cell) {
  constexpr std::size_t chunk = 512;
  const std::size_t count = sheet.cells();
  std::vector<std::array<Point, 4>> parts(count);
  const double sum = ordered_sum(
      count, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double part = 0;
        for (std::size_t c = begin; c < end; ++c) part += cell(c, parts[c]);
        return part;
      },
      chunk);
  if (!std::isfinite(sum)) return std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < count; ++c) {
    const auto v = sheet.corners(c);
    for (std::size_t k = 0; k < 4; ++k) add(1.0 / static_cast<double>(count), parts[c][k], gradient[v[k]]);
  }
  return sum / static_cast<double>(count);
}

CellEdges no_edges() { return CellEdges({Point{}, Point{}, Point{}, Point{}}); }

/// A^2 by the diagonals of a cell, whose sides need not lie in a plane, times a factor.
double area_term(const std::array<Point, 4>& x, double factor, std::array<Point, 4>& g) {
  const Point p = difference(x[2], x[0]), q = difference(x[3], x[1]);
  const double pp = dot(p, p), qq = dot(q, q), pq = dot(p, q);
  Point by_p{}, by_q{};
  add(0.5 * factor * qq, p, by_p), add(-0.5 * factor * pq, q, by_p);
  add(0.5 * factor * pp, q, by_q), add(-0.5 * factor * pq, p, by_q);
  add(1, by_p, g[2]), add(-1, by_p, g[0]), add(1, by_q, g[3]), add(-1, by_q, g[1]);
  return factor * (pp * qq - pq * pq) / 4;
}

double length_term(const CellEdges& e, double along, double across, CellEdges& by) {
  add(2 * along, e.south, by.south), add(2 * along, e.north, by.north);
  add(2 * across, e.west, by.west), add(2 * across, e.east, by.east);
  return along * (dot(e.south, e.south) + dot(e.north, e.north)) + across * (dot(e.west, e.west) + dot(e.east, e.east));
}

double orthogonality_term(const CellEdges& e, double factor, CellEdges& by) {
  const double c[] = {dot(e.south, e.west), dot(e.south, e.east), dot(e.north, e.east), dot(e.north, e.west)};
  const auto add_two = [&](double a, const Point& p, double b, const Point& q, Point& sum) {
    add(2 * factor * a, p, sum), add(2 * factor * b, q, sum);
  };
  add_two(c[0], e.west, c[1], e.east, by.south);
  add_two(c[1], e.south, c[2], e.north, by.east);
  add_two(c[2], e.east, c[3], e.west, by.north);
  add_two(c[0], e.south, c[3], e.north, by.west);
  return factor * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + c[3] * c[3]);
}

/// (|e|^2 / along2 + |f|^2 / across2) / |e x f| in the corners, times a factor.
double smoothness_term(const CellEdges& e, double along2, double across2, double factor, CellEdges& by) {
  const std::array<std::array<Point*, 2>, 4> targets = {
      {{&by.south, &by.west}, {&by.south, &by.east}, {&by.north, &by.east}, {&by.north, &by.west}}};
  const auto corners = e.corners();
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [a, b] = corners[k];
    Point normal = cross(a, b);
    const double j = length(normal), shape = dot(a, a) / along2 + dot(b, b) / across2;
    for (double& x : normal) x /= j;
    const double slope = -factor * shape / (j * j);
    add(2 * factor / (along2 * j), a, *targets[k][0]), add(slope, cross(b, normal), *targets[k][0]);
    add(2 * factor / (across2 * j), b, *targets[k][1]), add(slope, cross(normal, a), *targets[k][1]);
    sum += factor * shape / j;
  }
  return sum;
}

double cell_area(const std::array<Point, 4>& x) {
  return length(cross(difference(x[2], x[0]), difference(x[3], x[1]))) / 2;
}

Point middle(const std::array<Point, 4>& x) {
  Point sum{};
  for (const Point& p : x) add(0.25, p, sum);
  return sum;
}

}  // namespace

double corner_mean(const Sheet& sheet, const std::vector<Point>& nodes, CornerFunction corner,
                   const std::array<double, 4>& constants, std::vector<Point>& gradient) {
  return cell_mean(sheet, gradient, [&](std::size_t c, std::array<Point, 4>& g) {
    const CellEdges edges(corner_points(sheet, c, nodes));
    CellEdges by = no_edges();
    const std::array<std::array<Point*, 2>, 4> targets = {
        {{&by.south, &by.west}, {&by.south, &by.east}, {&by.north, &by.east}, {&by.north, &by.west}}};
    double sum = 0;
    const auto corners = edges.corners();
    for (std::size_t k = 0; k < 4; ++k) {
      Point by_along{}, by_across{};
      sum += corner(corners[k].along, corners[k].across, constants, by_along, by_across) / 4;
      add(0.25, by_along, *targets[k][0]), add(0.25, by_across, *targets[k][1]);
    }
    add_edges(by, g);
    return sum;
  });
}

SheetFunctional::SheetFunctional(const Sheet& sheet, const std::vector<Point>& nodes, const GridWeights& weights,
                                 const NodeDensity* attract, const SurfaceMap* map)
    : sheet_(sheet), weights_(weights), attract_(attract), map_(map) {
  const double all = weights.length + weights.smoothness + weights.area + weights.orthogonality;
  weights_ = {weights.length / all, std::max(weights.smoothness / all, least_smoothness), weights.area / all,
              weights.orthogonality / all};
  const std::vector<Point> x = map ? map->at(nodes).x : nodes;
  const auto [along, across] = mean_edges(sheet, x);
  double area = 0;
  for (std::size_t c = 0; c < sheet.cells(); ++c) area += cell_area(corner_points(sheet, c, x));
  along2_ = along * along;
  across2_ = across * across;
  area_ = area / static_cast<double>(sheet.cells());
  if (!attract_) return;
  double sum = 0;
  const Attraction w = attraction(x);
  for (std::size_t c = 0; c < sheet.cells(); ++c) sum += w.value[c] * cell_area(corner_points(sheet, c, x));
  attraction_ = sum / area;
}

SheetFunctional::Attraction SheetFunctional::attraction(const std::vector<Point>& x) const {
  const std::size_t cells = sheet_.cells();
  Attraction result{std::vector<double>(cells, 1), std::vector<Point>(cells)};
  if (!attract_) return result;
  std::vector<Point> middles(cells);
  for (std::size_t c = 0; c < cells; ++c) middles[c] = middle(corner_points(sheet_, c, x));
  const auto values = attract_->with_gradient(middles);
  for (std::size_t c = 0; c < cells; ++c) {
    result.value[c] = values[0][c] / attraction_;
    for (std::size_t k = 0; k < 3; ++k) result.gradient[c][k] = values[k + 1][c] / attraction_;
  }
  return result;
}

double SheetFunctional::metric(const std::vector<Point>& x, const GridWeights& weights,
                               std::vector<Point>& gradient) const {
  const Attraction attraction_here = attraction(x);
  const double area2 = area_ * area_;
  return cell_mean(sheet_, gradient, [&](std::size_t c, std::array<Point, 4>& g) {
    const auto corners = corner_points(sheet_, c, x);
    const double w = attraction_here.value[c];
    const CellEdges edges(corners);
    CellEdges by = no_edges();
    const double lengths =
        length_term(edges, weights.length * w / (4 * along2_), weights.length * w / (4 * across2_), by);
    const double angles = orthogonality_term(edges, weights.orthogonality * w * w / (8 * area2), by);
    const double root = std::sqrt(along2_ * across2_);
    const double shapes = smoothness_term(edges, along2_, across2_, weights.smoothness * root / std::sqrt(w) / 8, by);
    const double areas = area_term(corners, weights.area * w * w / (2 * area2), g);
    add_edges(by, g);
    for (Point& p : g) add((lengths - shapes / 2 + 2 * angles + 2 * areas) / w / 4, attraction_here.gradient[c], p);
    return lengths + shapes + areas + angles;
  });
}

double SheetFunctional::operator()(const std::vector<Point>& nodes, std::vector<Point>& gradient) const {
  gradient.assign(nodes.size(), Point{});
  if (first_folded(sheet_, nodes) < sheet_.cells()) return std::numeric_limits<double>::infinity();
  if (!map_) return metric(nodes, weights_, gradient);
  const SurfacePoints s = map_->at(nodes);
  std::vector<Point> in_space(nodes.size());
  const double value = metric(s.x, weights_, in_space);
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    gradient[v][0] += dot(s.xu[v], in_space[v]);
    gradient[v][1] += dot(s.xv[v], in_space[v]);
  }
  return value;
}

SheetFunctional::Parts SheetFunctional::parts(const std::vector<Point>& nodes) const {
  const std::vector<Point> x = map_ ? map_->at(nodes).x : nodes;
  std::vector<Point> unused(nodes.size());
  return {metric(x, {1, 0, 0, 0}, unused), metric(x, {0, 1, 0, 0}, unused), metric(x, {0, 0, 1, 0}, unused),
          metric(x, {0, 0, 0, 1}, unused)};
}

}  // namespace pelage
