#include "shape/split_along.h"

#include <algorithm>
#include <cmath>

#include "base/checked.h"
#include "shape/edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Of an edge: so far from the line new vertices lie, and what they keep from its ends: triangles need some area.
constexpr double aside = 0.03, least_part = 0.04;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class Splitter {
 public:
  Splitter(const std::vector<Triangle>& triangles, const std::vector<Point>& points)
      : triangles_(triangles), points_(points), new_on_(3 * triangles.size(), -1) {
    for (std::size_t v = 0; v < points.size(); ++v) {
      const auto number = static_cast<std::int32_t>(v);
      result_.vertex.push_back({number, number, 0});
    }
  }

  CutSurface surface(const LevelFunction& level, const Jump& least) {
    values_ = level(result_.vertex);
    find_crossings(level, least);
    for (const CutPlace& p : result_.vertex) places_.push_back(on_way(points_[at(p.from)], points_[at(p.to)], p.part));
    for (std::size_t t = 0; t < triangles_.size(); ++t) split(t);
    return std::move(result_);
  }

 private:
  bool crossed(std::int32_t a, std::int32_t b, const Jump& least) const {
    const double x = values_[at(a)], y = values_[at(b)];
    return (x > 0) != (y > 0) && std::abs(x - y) > least.jump &&
           length(difference(points_[at(a)], points_[at(b)])) >= least.length;
  }

  void find_crossings(const LevelFunction& level, const Jump& least) {
    const auto is_crossed = [&](const Triangle& t) {
      return crossed(t[0], t[1], least) || crossed(t[1], t[2], least) || crossed(t[2], t[0], least);
    };
    if (std::ranges::none_of(triangles_, is_crossed)) return;
    const EdgeTable edges(triangles_, points_.size());
    std::vector<CutPlace> open;
    std::vector<double> at_from, at_to;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::int32_t a = tail(triangles_, edges[e][0]), b = tip(triangles_, edges[e][0]);
      if (!crossed(a, b, least)) continue;
      for (const HalfEdge h : edges[e])
        new_on_[at(h)] = checked_count<std::int32_t>(points_.size() + open.size(), "vertices");
      open.push_back({a, b, 0});
      at_from.push_back(values_[at(a)]);
      at_to.push_back(values_[at(b)]);
    }
    for (CutPlace p : roots(std::move(open), std::move(at_from), std::move(at_to), level)) {
      p.part += values_[at(p.from)] > 0 ? std::min(aside, (1 - p.part) / 2) : -std::min(aside, p.part / 2);
      p.part = std::clamp(p.part, least_part, 1 - least_part);
      result_.vertex.push_back(p);
    }
  }

  /// The corners of a triangle and the new vertices of its edges, in turn.
  struct Outline {
    std::vector<std::int32_t> vertex;
    std::vector<CutPlace> corner;  ///< where they are between the corners
    std::vector<char> is_new;
  };
  Outline outline(std::size_t t) const {
    Outline o;
    for (std::int32_t k = 0; k < 3; ++k) {
      o.vertex.push_back(triangles_[t][at(k)]);
      o.corner.push_back({k, k, 0});
      o.is_new.push_back(0);
      const std::int32_t v = new_on_[3 * t + at(k)];
      if (v < 0) continue;
      const CutPlace& p = result_.vertex[at(v)];
      o.vertex.push_back(v);
      o.corner.push_back({k, (k + 1) % 3, p.from == triangles_[t][at(k)] ? p.part : 1 - p.part});
      o.is_new.push_back(1);
    }
    return o;
  }

  void split(std::size_t t) {
    const Outline o = outline(t);
    const std::size_t n = o.vertex.size();
    const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
      const std::array<std::size_t, 3> c{i % n, j % n, k % n};
      result_.triangles.push_back({o.vertex[c[0]], o.vertex[c[1]], o.vertex[c[2]]});
      result_.corners.push_back({o.corner[c[0]], o.corner[c[1]], o.corner[c[2]]});
      result_.parent.push_back(static_cast<std::int32_t>(t));
    };
    if (n == 3) return add(0, 1, 2);
    std::size_t i = 0;
    while (!o.is_new[i]) ++i;
    if (n == 4) {  // from the new vertex to the corner before it
      add(i, i + 1, i + 2);
      return add(i, i + 2, i + 3);
    }
    if (!o.is_new[(i + 2) % n]) i += 3;  // new are i and i + 2, with a corner between
    add(i, i + 1, i + 2);
    const auto diagonal = [&](std::size_t j, std::size_t k) {
      return length(difference(places_[at(o.vertex[j % n])], places_[at(o.vertex[k % n])]));
    };
    if (diagonal(i + 2, i + 4) <= diagonal(i + 3, i)) {
      add(i + 2, i + 3, i + 4);
      add(i + 2, i + 4, i);
    } else {
      add(i + 3, i + 4, i);
      add(i + 3, i, i + 2);
    }
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<Point>& points_;
  std::vector<double> values_;        ///< at the vertices
  std::vector<std::int32_t> new_on_;  ///< per half-edge: the new vertex, or -1
  std::vector<Point> places_;         ///< of all vertices
  CutSurface result_;
};

}  // namespace

CutSurface split_along(const std::vector<Triangle>& triangles, const std::vector<Point>& points,
                       const LevelFunction& level, const Jump& least) {
  return Splitter(triangles, points).surface(level, least);
}

}  // namespace pelage
