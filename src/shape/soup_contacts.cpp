#include "shape/soup_contacts.h"

#include <algorithm>
#include <cmath>

#include "shape/closest_point.h"
#include "shape/places.h"
#include "shape/soup_edges.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point along(const Point& p, double t, const Point& v) { return {p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]}; }

class ContactFinder {
 public:
  explicit ContactFinder(const TriangleMesh& mesh)
      : mesh_(mesh),
        place_(same_places(mesh.points, std::vector<char>(mesh.points.size(), 1))),
        twin_(soup_twins(mesh)) {
    found_.of.resize(mesh.triangles.size());
  }

  SoupContacts find() && {
    for (std::size_t h = 0; h < twin_.size(); ++h)
      if (twin_[h] >= 0 && at(twin_[h]) > h) meet_at_edge(h);
    if (std::ranges::count(twin_, -1) > 0) meet_over_cracks();
    return std::move(found_);
  }

 private:
  const Point& point(std::int32_t v) const { return mesh_.points[at(v)]; }
  std::int32_t begin(std::size_t h) const { return mesh_.triangles[h / 3][h % 3]; }
  std::int32_t end(std::size_t h) const { return mesh_.triangles[h / 3][(h + 1) % 3]; }

  void meet(std::size_t f, std::size_t g, double length) {
    found_.of[f].push_back({static_cast<std::int32_t>(g), length});
    found_.of[g].push_back({static_cast<std::int32_t>(f), length});
  }

  /// Triangles agree where they pass their edge in opposite directions.
  void meet_at_edge(std::size_t h) {
    const auto g = at(twin_[h]);
    const bool same = place_[at(begin(h))] == place_[at(begin(g))];
    const double size = length(difference(point(end(h)), point(begin(h))));
    meet(h / 3, g / 3, same ? -size : size);
  }

  /// From places on open edges to the open edges of others that pass within a small part of their length.
  void meet_over_cracks() {
    constexpr int places = 8;        // on an edge
    constexpr double widest = 0.02;  // crack, edges
    const DistanceTree tree(mesh_);
    for (std::size_t h = 0; h < twin_.size(); ++h) {
      if (twin_[h] != -1) continue;
      const Point edge = difference(point(end(h)), point(begin(h)));
      const double size = length(edge);
      int met = 0;
      for (int k = 0; k < places; ++k) {
        const Point from = along(point(begin(h)), (k + 0.5) / places, edge);
        bool any = false;
        for (const std::int32_t g : tree.within(from, widest * size))
          any |= at(g) != h / 3 && meet_at_place(h, at(g), from, widest * size, size / places);
        met += any;
      }
      if (2 * met < places) found_.open.push_back(static_cast<std::int32_t>(h));
    }
  }

  /// Unfolded about the edge h, the triangle g lies beyond it with the same side up, or with the other.
  bool meet_at_place(std::size_t h, std::size_t g, const Point& from, double reach, double share) {
    const Point t = unit(difference(point(end(h)), point(begin(h))));
    bool any = false;
    for (std::size_t e = 3 * g; e < 3 * g + 3; ++e) {
      if (twin_[e] != -1) continue;
      const Point edge = difference(point(end(e)), point(begin(e)));
      const Point way = difference(from, point(begin(e)));
      const double part = dot(way, edge) / dot(edge, edge);
      constexpr double parallel = 0.98;
      if (!(part >= 0 && part <= 1) || std::abs(dot(unit(edge), t)) < parallel) continue;
      if (length(difference(way, along({}, part, edge))) > reach) continue;
      meet(h / 3, g, dot(edge, t) < 0 ? share : -share);
      any = true;
    }
    return any;
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> place_, twin_;
  SoupContacts found_;
};

}  // namespace

SoupContacts soup_contacts(const TriangleMesh& mesh) { return ContactFinder(mesh).find(); }

}  // namespace pelage
