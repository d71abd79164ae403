#include "print/perforate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/checked.h"
#include "base/unions.h"
#include "shape/edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Of the shortest edge at a vertex: so near the line it moves onto it.
constexpr double near_vertex = 0.15;
/// Of an edge: what the line keeps from vertices that do not move.
constexpr double least_part = 0.05;
/// Cosine of the largest angle between faces at a vertex that may move.
constexpr double flat_enough = 0.94;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double length_between(const Point& a, const Point& b) { return length(difference(b, a)); }

class Perforator {
 public:
  Perforator(const std::vector<Triangle>& triangles, const std::vector<Point>& points, const LevelFunction& level)
      : triangles_(triangles), points_(points), edges_(triangles, points.size()) {
    find_crossings(level);
    find_near_vertices();
    avoid_pinches();
  }

  PerforatedSurface surface() {
    collect_places();
    for (std::size_t t = 0; t < triangles_.size(); ++t) cut(t);
    drop_islands();
    number_vertices();
    return std::move(result_);
  }

 private:
  std::int32_t vertex_count() const { return static_cast<std::int32_t>(points_.size()); }
  std::pair<std::int32_t, std::int32_t> ends(std::size_t e) const {
    const HalfEdge h = edges_[e][0];
    const std::int32_t a = tail(triangles_, h), b = tip(triangles_, h);
    return {std::min(a, b), std::max(a, b)};
  }

  void find_crossings(const LevelFunction& level) {
    std::vector<CutPlace> vertices;
    for (std::int32_t v = 0; v < vertex_count(); ++v) vertices.push_back({v, v, 0});
    const std::vector<double> values = level(vertices);
    for (const double x : values) hollow_.push_back(x > 0);
    std::vector<CutPlace> open;
    std::vector<double> at_from, at_to;
    edge_of_.resize(3 * triangles_.size());
    crossing_.assign(edges_.size(), -1);
    std::vector<std::size_t> crossed;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (const HalfEdge h : edges_[e]) edge_of_[at(h)] = e;
      const auto [a, b] = ends(e);
      if (hollow_[at(a)] == hollow_[at(b)]) continue;
      crossed.push_back(e);
      open.push_back({a, b, 0});
      at_from.push_back(values[at(a)]);
      at_to.push_back(values[at(b)]);
    }
    const std::vector<CutPlace> found = roots(std::move(open), std::move(at_from), std::move(at_to), level);
    for (std::size_t i = 0; i < crossed.size(); ++i) crossing_[crossed[i]] = found[i].part;
  }

  std::vector<double> shortest_edges() const {
    std::vector<double> shortest(points_.size(), std::numeric_limits<double>::infinity());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto [a, b] = ends(e);
      const double l = length_between(points_[at(a)], points_[at(b)]);
      for (const std::int32_t v : {a, b}) shortest[at(v)] = std::min(shortest[at(v)], l);
    }
    return shortest;
  }

  /// Vertices whose faces lie in about one plane, inside the surface.
  std::vector<char> movable() const {
    std::vector<char> may(points_.size(), 1);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto [a, b] = ends(e);
      const bool flat =
          edges_[e].size() == 2 && dot(normal(at(edges_[e][0] / 3)), normal(at(edges_[e][1] / 3))) > flat_enough;
      if (!flat) may[at(a)] = may[at(b)] = 0;
    }
    return may;
  }
  Point normal(std::size_t t) const {
    const auto p = [&](std::size_t k) { return points_[at(triangles_[t][k])]; };
    return unit(cross(difference(p(1), p(0)), difference(p(2), p(0))));
  }

  void find_near_vertices() {
    const std::vector<double> shortest = shortest_edges();
    const std::vector<char> may = movable();
    std::vector<double> nearest(points_.size(), 0.0);
    onto_.assign(points_.size(), none);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (crossing_[e] < 0) continue;
      const auto [a, b] = ends(e);
      const double l = length_between(points_[at(a)], points_[at(b)]);
      for (const auto& [v, d] : {std::pair{at(a), crossing_[e] * l}, {at(b), (1 - crossing_[e]) * l}}) {
        if (!may[v] || d > near_vertex * shortest[v] || (onto_[v] != none && nearest[v] <= d)) continue;
        onto_[v] = e;
        nearest[v] = d;
      }
    }
  }

  /// 1 in a hole, -1 outside, 0 on its border.
  int sign(std::int32_t v) const { return onto_[at(v)] != none ? 0 : hollow_[at(v)] ? 1 : -1; }

  /// Whether anything of a triangle is left. One with all corners on the border goes by what most of them were.
  bool is_left(std::size_t t) const {
    int low = 0, high = 0, hollow = 0;
    for (const std::int32_t v : triangles_[t]) {
      low += sign(v) < 0;
      high += sign(v) > 0;
      hollow += hollow_[at(v)];
    }
    return low > 0 || (high == 0 && hollow < 2);
  }

  /// Where what is left around a vertex on the border is more than one fan, the vertex stays where it was.
  void avoid_pinches() {
    for (bool changed = true; changed;) {
      std::vector<int> corners(points_.size(), 0), joints(points_.size(), 0);
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (const std::int32_t v : triangles_[t]) corners[at(v)] += is_left(t);
      for (std::size_t e = 0; e < edges_.size(); ++e)
        if (edges_[e].size() == 2 && is_left(at(edges_[e][0] / 3)) && is_left(at(edges_[e][1] / 3))) {
          const auto [a, b] = ends(e);
          // An end in a hole, and the other on its border: nothing is left of the edge.
          if (sign(b) <= 0) joints[at(a)] += 1;
          if (sign(a) <= 0) joints[at(b)] += 1;
        }
      changed = false;
      for (std::size_t v = 0; v < onto_.size(); ++v)
        if (onto_[v] != none && corners[v] - joints[v] > 1) {
          onto_[v] = none;
          changed = true;
        }
    }
  }

  /// Vertices where they are now, and behind them the crossings.
  void collect_places() {
    for (std::int32_t v = 0; v < vertex_count(); ++v) {
      const std::size_t e = onto_[at(v)];
      if (e == none) {
        places_.push_back({v, v, 0});
        continue;
      }
      const auto [a, b] = ends(e);
      places_.push_back(v == a ? CutPlace{a, b, crossing_[e]} : CutPlace{b, a, 1 - crossing_[e]});
    }
    number_of_.assign(edges_.size(), -1);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto [a, b] = ends(e);
      if (sign(a) * sign(b) >= 0) continue;
      number_of_[e] = checked_count<std::int32_t>(places_.size(), "vertices");
      places_.push_back({a, b, std::clamp(crossing_[e], least_part, 1 - least_part)});
    }
    for (const CutPlace& p : places_) moved_.push_back(on_way(points_[at(p.from)], points_[at(p.to)], p.part));
  }

  void cut(std::size_t t) {
    if (!is_left(t)) return;
    std::vector<std::int32_t> polygon;
    std::vector<CutPlace> corner;
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t v = triangles_[t][at(k)], next = (k + 1) % 3, w = triangles_[t][at(next)];
      if (sign(v) <= 0) {
        polygon.push_back(v);
        corner.push_back({k, k, 0});
      }
      const std::size_t e = edge_of_[3 * t + at(k)];
      if (number_of_[e] < 0) continue;
      polygon.push_back(number_of_[e]);
      const double part = places_[at(number_of_[e])].part;
      corner.push_back({k, next, v < w ? part : 1 - part});
    }
    add(t, polygon, corner);
  }

  /// Three or four corners; four are cut along the shorter diagonal.
  void add(std::size_t t, const std::vector<std::int32_t>& polygon, const std::vector<CutPlace>& corner) {
    const auto triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
      result_.triangles.push_back({polygon[i], polygon[j], polygon[k]});
      result_.corners.push_back({corner[i], corner[j], corner[k]});
      result_.parent.push_back(static_cast<std::int32_t>(t));
    };
    const auto diagonal = [&](std::size_t i, std::size_t j) {
      return length_between(moved_[at(polygon[i])], moved_[at(polygon[j])]);
    };
    if (polygon.size() == 3) return triangle(0, 1, 2);
    const std::size_t first = diagonal(0, 2) <= diagonal(1, 3) ? 0 : 1;
    triangle(first, first + 1, first + 2);
    triangle(first, first + 2, (first + 3) % 4);
  }

  double area(const Triangle& t) const {
    return length(
               cross(difference(moved_[at(t[1])], moved_[at(t[0])]), difference(moved_[at(t[2])], moved_[at(t[0])]))) /
           2;
  }

  void drop_islands() {
    Unions before(points_.size()), pieces(places_.size());
    for (const Triangle& t : triangles_)
      for (const std::int32_t v : {t[1], t[2]}) before.unite(t[0], v);
    std::map<std::int32_t, double> areas;
    for (const Triangle& t : result_.triangles)
      for (const std::int32_t v : {t[1], t[2]}) pieces.unite(t[0], v);
    for (const Triangle& t : result_.triangles) areas[pieces.root(t[0])] += area(t);
    std::map<std::int32_t, std::int32_t> largest;  // piece of each part of the surface
    for (std::size_t t = 0; t < result_.triangles.size(); ++t) {
      const std::int32_t piece = pieces.root(result_.triangles[t][0]);
      const auto [best, first] = largest.emplace(before.root(triangles_[at(result_.parent[t])][0]), piece);
      if (!first && areas[piece] > areas[best->second]) best->second = piece;
    }
    std::map<std::int32_t, bool> stays;
    for (const auto& [part, piece] : largest) stays[piece] = true;
    for (const auto& [piece, size] : areas) {
      result_.islands += !stays[piece];
      (stays[piece] ? result_.area : result_.island_area) += size;
    }
    keep_triangles([&](std::size_t t) { return stays[pieces.root(result_.triangles[t][0])]; });
  }

  template <class Keep>
  void keep_triangles(const Keep& keep) {
    std::size_t n = 0;
    for (std::size_t t = 0; t < result_.triangles.size(); ++t) {
      if (!keep(t)) continue;
      result_.triangles[n] = result_.triangles[t];
      result_.parent[n] = result_.parent[t];
      result_.corners[n++] = result_.corners[t];
    }
    result_.triangles.resize(n);
    result_.parent.resize(n);
    result_.corners.resize(n);
  }

  void number_vertices() {
    std::vector<std::int32_t> number(places_.size(), -1);
    for (const Triangle& t : result_.triangles)
      for (const std::int32_t v : t) number[at(v)] = 0;
    for (std::size_t v = 0; v < places_.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<std::int32_t>(result_.vertex.size());
      result_.vertex.push_back(places_[v]);
    }
    for (Triangle& t : result_.triangles)
      for (std::int32_t& v : t) v = number[at(v)];
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<Point>& points_;
  const EdgeTable edges_;
  std::vector<std::size_t> edge_of_;     ///< of the half-edges
  std::vector<char> hollow_;             ///< per vertex: whether it lies in a hole
  std::vector<double> crossing_;         ///< per edge, from the smaller end; -1 without
  std::vector<std::size_t> onto_;        ///< per vertex: the edge to whose crossing it moves, or none
  std::vector<CutPlace> places_;         ///< of the vertices, and of crossings
  std::vector<std::int32_t> number_of_;  ///< of the crossing of an edge among the places, or -1
  std::vector<Point> moved_;             ///< the places in space
  PerforatedSurface result_;
};

}  // namespace

PerforatedSurface perforated(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                             const LevelFunction& level) {
  return Perforator(triangles, points, level).surface();
}

}  // namespace pelage
