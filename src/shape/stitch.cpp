#include "shape/stitch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>

#include "shape/places.h"
#include "shape/vectors.h"

namespace pelage {

std::vector<std::int32_t> open_places(const TriangleMesh& mesh, const EdgeTable& edges) {
  std::vector<char> open(mesh.points.size(), 0);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1) open[tail(mesh.triangles, edges[e][0])] = open[tip(mesh.triangles, edges[e][0])] = 1;
  return same_places(mesh.points, open);
}

// --- pairing ------------------------------------------------------------------------------------------------

namespace {

[[noreturn]] void refuse(const NumberedMesh& work, std::span<const HalfEdge> faces) {
  const std::vector<Triangle>& triangles = work.mesh.triangles;
  const HalfEdge h = *std::max_element(faces.begin(), faces.end());
  std::string others;
  for (HalfEdge g : faces)
    if (g != h && others.size() < 60) others += (others.empty() ? "" : ", ") + std::to_string(work.face_number[g / 3]);
  throw ShapeFault(ShapeFault::Element::face, work.face_number[h / 3],
                   "its edge between vertices " + std::to_string(work.vertex_number[tail(triangles, h)]) + " and " +
                       std::to_string(work.vertex_number[tip(triangles, h)]) + " belongs to " +
                       std::to_string(faces.size()) + " faces (also " + others +
                       "), but on a surface two faces meet at an edge; remove inner faces or separate the parts");
}

class Pairing {
 public:
  Pairing(const NumberedMesh& work, const std::vector<std::int32_t>& place)
      : work_(work), mesh_(work.mesh), place_(place), opposite(3 * work.mesh.triangles.size(), -1) {}

  /// Pairs the half-edges of one edge.
  void pair(std::span<const HalfEdge> edge) {
    if (edge.size() == 2) return join(edge[0], edge[1]);
    if (edge.size() < 3) return;
    crowded = true;
    const std::vector<HalfEdge> rest = pair_same_vertices(edge);
    if (rest.size() == 2) return join(rest[0], rest[1]);
    if (rest.size() < 3) return;
    if (!pair_around(rest)) refuse(work_, rest);
    if (touching_count_++ == 0) first_touching_ = rest[0] / 3;
  }

  void report(std::vector<Finding>& findings) const {
    if (touching_count_ == 0) return;
    const std::size_t face = work_.face_number[first_touching_];
    findings.push_back({"touching-edges",
                        counted(touching_count_, "edge") + " where solids touch each other (first: at face " +
                            std::to_string(face) + "); separated",
                        touching_count_, face, true});
  }

 private:
  void join(HalfEdge a, HalfEdge b) {
    opposite[a] = b;
    opposite[b] = a;
  }

  /// Pairs those that alone share their vertices, not only the places; returns the others.
  std::vector<HalfEdge> pair_same_vertices(std::span<const HalfEdge> edge) {
    auto same = [&](HalfEdge a, HalfEdge b) {
      return std::minmax(tail(mesh_.triangles, a), tip(mesh_.triangles, a)) ==
             std::minmax(tail(mesh_.triangles, b), tip(mesh_.triangles, b));
    };
    std::vector<HalfEdge> sorted(edge.begin(), edge.end()), rest;
    std::sort(sorted.begin(), sorted.end(), [&](HalfEdge a, HalfEdge b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < sorted.size();) {
      std::size_t end = i + 1;
      while (end < sorted.size() && same(sorted[i], sorted[end])) ++end;
      if (end - i == 2)
        join(sorted[i], sorted[i + 1]);
      else
        rest.insert(rest.end(), sorted.begin() + static_cast<std::ptrdiff_t>(i),
                    sorted.begin() + static_cast<std::ptrdiff_t>(end));
      i = end;
    }
    return rest;
  }

  std::array<std::int32_t, 3> key(HalfEdge h) const {
    const std::int32_t a = tail(mesh_.triangles, h), b = tip(mesh_.triangles, h);
    return {std::min(a, b), std::max(a, b), h};
  }

  /// Seen along the edge from `from` to `to`, a face whose half-edge goes the same way ("forward") has the solid
  /// on its clockwise side, one that goes back on its counter-clockwise side. So a wedge of solid runs
  /// counter-clockwise from a backward face to the next forward one; these two are joined.
  bool pair_around(const std::vector<HalfEdge>& faces) {
    struct Spoke {
      double angle;
      bool forward;
      HalfEdge h;
    };
    const std::int32_t from = tail(mesh_.triangles, faces[0]), to = tip(mesh_.triangles, faces[0]);
    const Point origin = mesh_.points[from], axis = unit(difference(mesh_.points[to], origin));
    Point x{}, y{};
    std::vector<Spoke> spokes;
    for (HalfEdge h : faces) {
      const std::int32_t apex = tip(mesh_.triangles, next_in_face(h));
      const Point arm =
          cross(axis, difference(mesh_.points[apex], origin));  // turned by a right angle, which is the same for all
      if (spokes.empty()) {
        x = unit(arm);
        y = cross(axis, x);
      }
      double angle = std::atan2(dot(arm, y), dot(arm, x));
      if (!std::isfinite(angle)) return false;
      spokes.push_back({angle, place_[tail(mesh_.triangles, h)] == place_[from], h});
    }
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
    constexpr double together = 1e-9;  // radians; faces closer than this lie on each other
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Spoke &a = spokes[i], &b = spokes[(i + 1) % spokes.size()];
      const double gap = b.angle - a.angle + (i + 1 == spokes.size() ? 2 * std::numbers::pi : 0);
      if (a.forward == b.forward || gap < together) return false;
    }
    for (std::size_t i = 0; i < spokes.size(); ++i)
      if (!spokes[i].forward) join(spokes[i].h, spokes[(i + 1) % spokes.size()].h);
    return true;
  }

  const NumberedMesh& work_;
  const TriangleMesh& mesh_;
  const std::vector<std::int32_t>& place_;
  std::size_t touching_count_ = 0;
  HalfEdge first_touching_ = 0;

 public:
  std::vector<HalfEdge> opposite;
  bool crowded = false;
};

}  // namespace

EdgeTable edges_of_places(const TriangleMesh& mesh, const std::vector<std::int32_t>& place) {
  std::vector<Triangle> places = mesh.triangles;
  for (Triangle& t : places)
    for (std::int32_t& v : t) v = place[v];
  return EdgeTable(places, place.size());
}

EdgePairs pair_half_edges(const NumberedMesh& work, const std::vector<std::int32_t>& place, const EdgeTable& edges,
                          std::vector<Finding>& findings) {
  Pairing pairing(work, place);
  for (std::size_t e = 0; e < edges.size(); ++e) pairing.pair(edges[e]);
  pairing.report(findings);
  return {std::move(pairing.opposite), pairing.crowded};
}

// --- fans ---------------------------------------------------------------------------------------------------

namespace {

/// For each corner the smallest corner of its fan.
std::vector<std::int32_t> fans(const TriangleMesh& mesh, const std::vector<HalfEdge>& opposite) {
  std::vector<std::int32_t> parent(opposite.size());
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](std::int32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  auto join = [&](std::int32_t a, std::int32_t b) {
    a = root(a), b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(opposite.size()); ++h) {
    const HalfEdge g = opposite[h];
    if (g < h) continue;
    // Corner h lies at the tail of half-edge h. Compared are points: the numbers may differ along a seam.
    const bool same_way = mesh.points[tail(mesh.triangles, h)] == mesh.points[tail(mesh.triangles, g)];
    join(h, same_way ? g : next_in_face(g));
    join(next_in_face(h), same_way ? next_in_face(g) : g);
  }
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(parent.size()); ++c) parent[c] = root(c);
  return parent;
}

/// New vertices: the old one that each copies, the number of each corner, and what happened on the way.
struct Renumbering {
  std::vector<std::int32_t> source;
  std::vector<std::int32_t> corner;
  Finding seams{"seams", "", 0, 0, true};
  Finding touching{"touching-vertices", "", 0, 0, true};
};

Renumbering number_fans(const NumberedMesh& work, const std::vector<std::int32_t>& fan) {
  const TriangleMesh& mesh = work.mesh;
  const auto corners = static_cast<std::int32_t>(fan.size());
  std::vector<std::int32_t> wanted(fan.size(), -1);  // per first corner of a fan: its smallest vertex
  std::vector<char> used(mesh.points.size(), 0);
  for (std::int32_t c = 0; c < corners; ++c) {
    const std::int32_t v = tail(mesh.triangles, c);
    used[v] = 1;
    wanted[fan[c]] = wanted[fan[c]] < 0 ? v : std::min(wanted[fan[c]], v);
  }
  std::vector<std::int32_t> owner(mesh.points.size(), -1);  // per old vertex: the fan that keeps it
  std::vector<std::int32_t> others;
  for (std::int32_t c = 0; c < corners; ++c) {
    if (fan[c] != c) continue;
    if (owner[wanted[c]] < 0)
      owner[wanted[c]] = c;
    else
      others.push_back(c);
  }
  Renumbering result;
  std::vector<std::int32_t> number(fan.size(), -1);  // per first corner of a fan: its new vertex
  auto add = [&](std::int32_t old_vertex, std::int32_t first_corner) {
    if (first_corner >= 0) number[first_corner] = static_cast<std::int32_t>(result.source.size());
    result.source.push_back(old_vertex);
  };
  for (std::size_t v = 0; v < owner.size(); ++v) {
    if (owner[v] >= 0 || !used[v])
      add(static_cast<std::int32_t>(v), owner[v]);
    else if (result.seams.count++ == 0)
      result.seams.element = work.vertex_number[v];
  }
  for (std::int32_t c : others) {
    add(wanted[c], c);
    if (result.touching.count++ == 0) result.touching.element = work.vertex_number[wanted[c]];
  }
  result.corner.resize(fan.size());
  for (std::int32_t c = 0; c < corners; ++c) result.corner[c] = number[fan[c]];
  return result;
}

/// Sheets that touch along an edge can still be joined at both its ends: then no numbers tell them apart.
void check_separation(const NumberedMesh& work, const Renumbering& renumbering) {
  std::vector<Triangle> triangles(work.mesh.triangles.size());
  for (std::size_t c = 0; c < renumbering.corner.size(); ++c) triangles[c / 3][c % 3] = renumbering.corner[c];
  const EdgeTable edges(triangles, renumbering.source.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() > 2) refuse(work, edges[e]);
}

/// Makes a corner attribute of every vertex attribute that is not the same on both sides of a seam.
void keep_seams(TriangleMesh& mesh, const Renumbering& renumbering) {
  for (Attribute& a : mesh.attributes) {
    if (a.domain != Domain::vertex) continue;
    auto tuple = [&](std::int32_t v) { return a.values.begin() + static_cast<std::ptrdiff_t>(v) * a.components; };
    bool differs = false;
    for (HalfEdge c = 0; c < static_cast<HalfEdge>(renumbering.corner.size()) && !differs; ++c) {
      const std::int32_t v = tail(mesh.triangles, c), kept = renumbering.source[renumbering.corner[c]];
      differs = v != kept && !std::equal(tuple(v), tuple(v) + a.components, tuple(kept));
    }
    if (!differs) continue;
    std::vector<double> values;
    values.reserve(renumbering.corner.size() * a.components);
    for (const Triangle& t : mesh.triangles)
      for (std::int32_t v : t) values.insert(values.end(), tuple(v), tuple(v) + a.components);
    a.values = std::move(values);
    a.domain = Domain::corner;
  }
}

/// Corners that get another vertex than they had, where no vertex comes or goes.
std::size_t moved_corners(const TriangleMesh& mesh, const Renumbering& renumbering) {
  std::size_t moved = 0;
  for (HalfEdge c = 0; c < static_cast<HalfEdge>(renumbering.corner.size()); ++c)
    if (renumbering.source[renumbering.corner[c]] != tail(mesh.triangles, c)) ++moved;
  return moved;
}

}  // namespace

void renumber_by_fans(NumberedMesh& work, const EdgePairs& pairs, std::vector<Finding>& findings) {
  Renumbering renumbering = number_fans(work, fans(work.mesh, pairs.opposite));
  if (pairs.crowded) check_separation(work, renumbering);
  Finding &seams = renumbering.seams, &touching = renumbering.touching;
  const std::size_t moved = moved_corners(work.mesh, renumbering);
  if (moved == 0 && seams.count == 0 && touching.count == 0) return;
  keep_seams(work.mesh, renumbering);
  gather_vertices(work, renumbering.source);
  for (std::size_t c = 0; c < renumbering.corner.size(); ++c) work.mesh.triangles[c / 3][c % 3] = renumbering.corner[c];
  if (seams.count == 0 && touching.count == 0)
    findings.push_back(
        {"seams", counted(moved, "corner") + " of faces joined to other vertices in the same place", moved, 0, true});
  if (seams.count > 0) {
    seams.text = counted(seams.count, "vertex") + " in the place of others along open edges (first: vertex " +
                 std::to_string(seams.element) + "); merged";
    findings.push_back(seams);
  }
  if (touching.count > 0) {
    touching.text = "sheets that touch only in a vertex (first: vertex " + std::to_string(touching.element) +
                    "); separated with the help of " + counted(touching.count, "vertex") + " more";
    findings.push_back(touching);
  }
}

}  // namespace pelage
