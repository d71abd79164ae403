#include "shape/soup_orient.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/box.h"
#include "shape/closest_point.h"
#include "shape/places.h"
#include "shape/soup_edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point along(const Point& p, double t, const Point& v) { return {p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]}; }

/// A triangle that meets another one.
struct Contact {
  std::int32_t other;
  double length;  ///< of what they share, less than 0 where they disagree
};

class SoupOrientation {
 public:
  explicit SoupOrientation(const TriangleMesh& mesh)
      : mesh_(mesh),
        place_(same_places(mesh.points, std::vector<char>(mesh.points.size(), 1))),
        twin_(soup_twins(mesh)),
        contacts_(mesh.triangles.size()) {
    for (const Triangle& t : mesh.triangles)
      normal_.push_back(cross(difference(point(t[1]), point(t[0])), difference(point(t[2]), point(t[0]))));
    for (std::size_t h = 0; h < twin_.size(); ++h)
      if (twin_[h] >= 0 && at(twin_[h]) > h) meet_at_edge(h);
    if (std::ranges::count(twin_, -1) > 0) meet_over_cracks();
  }

  /// Which triangles to reverse.
  std::vector<char> reversed() const {
    std::vector<char> reverse(mesh_.triangles.size(), 0), done = reverse;
    for (std::size_t f = 0; f < reverse.size(); ++f) {
      if (done[f]) continue;
      const std::vector<std::size_t> piece = spread(f, reverse, done);
      double kept = 0;
      for (const std::size_t t : piece) kept += (reverse[t] ? -1 : 1) * length(normal_[t]);
      if (kept < 0)
        for (const std::size_t t : piece) reverse[t] = !reverse[t];
    }
    return reverse;
  }

 private:
  const Point& point(std::int32_t v) const { return mesh_.points[at(v)]; }

  void meet(std::size_t f, std::size_t g, double length) {
    contacts_[f].push_back({static_cast<std::int32_t>(g), length});
    contacts_[g].push_back({static_cast<std::int32_t>(f), length});
  }

  /// Triangles agree where they pass their edge in opposite directions.
  void meet_at_edge(std::size_t h) {
    const auto g = at(twin_[h]);
    const bool same = place_[at(begin(h))] == place_[at(begin(g))];
    const double size = length(difference(point(end(h)), point(begin(h))));
    meet(h / 3, g / 3, same ? -size : size);
  }
  std::int32_t begin(std::size_t h) const { return mesh_.triangles[h / 3][h % 3]; }
  std::int32_t end(std::size_t h) const { return mesh_.triangles[h / 3][(h + 1) % 3]; }

  /// From places on open edges to the open edges of others that pass within a small part of their length.
  void meet_over_cracks() {
    constexpr int places = 8;        // on an edge
    constexpr double widest = 0.02;  // crack, edges
    const DistanceTree tree(mesh_);
    for (std::size_t h = 0; h < twin_.size(); ++h) {
      if (twin_[h] != -1) continue;
      const Point edge = difference(point(end(h)), point(begin(h)));
      const double size = length(edge);
      for (int k = 0; k < places; ++k) {
        const Point from = along(point(begin(h)), (k + 0.5) / places, edge);
        for (const std::int32_t g : tree.within(from, widest * size))
          if (at(g) != h / 3) meet_at_place(h, at(g), from, widest * size, size / places);
      }
    }
  }

  /// Unfolded about the edge h, the triangle g lies beyond it with the same side up, or with the other.
  void meet_at_place(std::size_t h, std::size_t g, const Point& from, double reach, double share) {
    const Point t = unit(difference(point(end(h)), point(begin(h))));
    for (std::size_t e = 3 * g; e < 3 * g + 3; ++e) {
      if (twin_[e] != -1) continue;
      const Point edge = difference(point(end(e)), point(begin(e)));
      const Point way = difference(from, point(begin(e)));
      const double part = dot(way, edge) / dot(edge, edge);
      constexpr double parallel = 0.98;
      if (!(part >= 0 && part <= 1) || std::abs(dot(unit(edge), t)) < parallel) continue;
      if (length(difference(way, along({}, part, edge))) > reach) continue;
      meet(h / 3, g, dot(edge, t) < 0 ? share : -share);
    }
  }

  /// Over the longest contacts first; the triangles that were reached.
  std::vector<std::size_t> spread(std::size_t first, std::vector<char>& reverse, std::vector<char>& done) const {
    struct Step {
      double length;
      std::size_t to;
      bool reverse;
      bool operator<(const Step& s) const { return length != s.length ? length < s.length : to > s.to; }
    };
    std::priority_queue<Step> open;
    std::vector<std::size_t> piece;
    open.push({0, first, false});
    while (!open.empty()) {
      const Step step = open.top();
      open.pop();
      if (done[step.to]) continue;
      done[step.to] = 1;
      reverse[step.to] = step.reverse;
      piece.push_back(step.to);
      for (const Contact& c : contacts_[step.to])
        open.push({std::abs(c.length), at(c.other), step.reverse != (c.length < 0)});
    }
    return piece;
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> place_, twin_;
  std::vector<Point> normal_;  ///< times twice the area
  std::vector<std::vector<Contact>> contacts_;
};

/// The last two corners change places.
void reverse_triangle(TriangleMesh& mesh, std::size_t f) {
  std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  for (Attribute& a : mesh.attributes) {
    if (a.domain != Domain::corner) continue;
    const std::size_t n = at(a.components);
    const auto second = a.values.begin() + static_cast<std::ptrdiff_t>(n * (3 * f + 1));
    std::swap_ranges(second, second + static_cast<std::ptrdiff_t>(n), second + static_cast<std::ptrdiff_t>(n));
  }
}

}  // namespace

std::size_t orient_soup(TriangleMesh& mesh) {
  const std::vector<char> reversed = SoupOrientation(mesh).reversed();
  for (std::size_t f = 0; f < reversed.size(); ++f)
    if (reversed[f]) reverse_triangle(mesh, f);
  return static_cast<std::size_t>(std::ranges::count(reversed, 1));
}

}  // namespace pelage
