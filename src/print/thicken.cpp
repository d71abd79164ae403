#include "print/thicken.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/checked.h"
#include "print/kept_apart.h"
#include "print/self_meeting.h"
#include "shape/edges.h"
#include "shape/normals.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A corner of the wall: of a triangle of the surface, on one side or the other.
struct WallCorner {
  std::size_t corner;
  bool beyond;
};

/// A triangle of the wall, with the triangle of the surface that its corners belong to.
struct WallTriangle {
  std::size_t triangle;
  std::array<WallCorner, 3> corner;
};

std::vector<HalfEdge> border_of(const TriangleMesh& surface) {
  std::vector<HalfEdge> border;
  const EdgeTable edges(surface.triangles, surface.points.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1) border.push_back(edges[e][0]);
  return border;
}

class WallBuilder {
 public:
  explicit WallBuilder(const TriangleMesh& surface)
      : surface_(surface), beyond_(checked_count<std::int32_t>(surface.points.size(), "vertices")) {
    checked_count<std::int32_t>(2 * surface.points.size(), "vertices");
    const std::size_t n = surface.triangles.size();
    for (std::size_t t = 0; t < n; ++t) add(t, {{{0, false}, {1, false}, {2, false}}}, 0);
    for (std::size_t t = 0; t < n; ++t) add(t, {{{2, true}, {1, true}, {0, true}}}, 1);
    for (const HalfEdge h : border_of(surface)) {
      const std::size_t a = at(h % 3), b = at(next_in_face(h) % 3);
      add(at(h / 3), {{{b, false}, {a, false}, {a, true}}}, 2);
      add(at(h / 3), {{{b, false}, {a, true}, {b, true}}}, 2);
    }
  }

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result;
    for (const WallTriangle& w : wall_) {
      Triangle& t = result.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        t[k] = surface_.triangles[w.triangle][w.corner[k].corner] + (w.corner[k].beyond ? beyond_ : 0);
    }
    return result;
  }

  Attribute attribute(const Attribute& a) const {
    Attribute result{a.name, a.components, a.domain, {}, a.type, a.labels};
    const auto n = static_cast<std::ptrdiff_t>(a.components);
    const auto take = [&](std::size_t tuple) {
      const auto first = a.values.begin() + n * static_cast<std::ptrdiff_t>(tuple);
      result.values.insert(result.values.end(), first, first + n);
    };
    if (a.domain == Domain::vertex)
      for (std::size_t v = 0; v < 2 * surface_.points.size(); ++v) take(v % surface_.points.size());
    for (const WallTriangle& w : wall_) {
      if (a.domain == Domain::face) take(w.triangle);
      for (std::size_t k = 0; k < 3 && a.domain == Domain::corner; ++k) take(3 * w.triangle + w.corner[k].corner);
    }
    return result;
  }

  /// Marks the triangles that stem from marked ones.
  std::vector<char> marked(const std::vector<char>& of_surface) const {
    std::vector<char> result;
    for (const WallTriangle& w : wall_) result.push_back(of_surface[w.triangle]);
    return result;
  }
  const std::vector<std::uint8_t>& part() const { return part_; }

 private:
  void add(std::size_t triangle, const std::array<WallCorner, 3>& corners, std::uint8_t part) {
    wall_.push_back({triangle, corners});
    part_.push_back(part);
  }

  const TriangleMesh& surface_;
  std::int32_t beyond_;  ///< added to the number of a vertex for the other side
  std::vector<WallTriangle> wall_;
  std::vector<std::uint8_t> part_;
};

/// Vectors along which faces move by a length of 1: those d with n . d = 1 for the normals n of the faces around, by
/// least squares that are weighted by areas. Across the normals they are means of their neighbours', so that the faces
/// beside a crease move aside with it.
class FaceDistances {
 public:
  explicit FaceDistances(const TriangleMesh& surface)
      : surface_(surface),
        squares_(surface.points.size(), Eigen::Matrix3d::Zero()),
        sums_(surface.points.size(), Eigen::Vector3d::Zero()) {
    for (const Triangle& t : surface.triangles) {
      const Point n = cross(difference(surface.points[at(t[1])], surface.points[at(t[0])]),
                            difference(surface.points[at(t[2])], surface.points[at(t[0])]));
      const Eigen::Vector3d doubled_area = Eigen::Vector3d::Map(n.data());
      if (!(doubled_area.norm() > 0)) continue;
      for (const std::int32_t v : t) {
        squares_[at(v)] += doubled_area * doubled_area.transpose() / doubled_area.norm();
        sums_[at(v)] += doubled_area;
      }
    }
    for (const Point& n : vertex_normals(surface.triangles, surface.points))
      way_.push_back(Eigen::Vector3d::Map(n.data()));
    correct();
  }

  /// Spreads what happens at creases as far as a wall is thick.
  std::vector<Point> spread(double thickness) {
    constexpr double most_rounds = 100;
    const double edge = prevailing_edge(surface_.triangles, surface_.points), rows = thickness / edge;
    const int rounds = static_cast<int>(std::min(most_rounds, std::ceil(4 * rows * rows)));
    for (int round = 0; round < rounds; ++round) {
      average();
      correct();
    }
    std::vector<Point> result;
    for (const Eigen::Vector3d& d : way_) result.push_back({d[0], d[1], d[2]});
    return result;
  }

 private:
  void average() {
    std::vector<Eigen::Vector3d> mean(way_.size(), Eigen::Vector3d::Zero());
    std::vector<double> count(way_.size(), 0.0);
    for (const Triangle& t : surface_.triangles)
      for (const std::int32_t v : t) {
        mean[at(v)] += way_[at(t[0])] + way_[at(t[1])] + way_[at(t[2])];
        count[at(v)] += 3;
      }
    for (std::size_t v = 0; v < way_.size(); ++v)
      if (count[v] > 0) way_[v] = mean[v] / count[v];
  }

  void correct() {
    constexpr double flat = 1e-3;  // what bends less leaves the way where it is across the normal
    constexpr double longest = 2;  // at sharp edges and tips
    for (std::size_t v = 0; v < way_.size(); ++v) {
      const double area = squares_[v].trace();
      if (!(area > 0)) continue;
      const Eigen::Matrix3d system = squares_[v] + flat * area * Eigen::Matrix3d::Identity();
      way_[v] += system.ldlt().solve(sums_[v] - squares_[v] * way_[v]);
      way_[v] *= std::min(1.0, longest / way_[v].norm());
    }
  }

  const TriangleMesh& surface_;
  std::vector<Eigen::Matrix3d> squares_;  ///< of the normals, times areas, around each vertex
  std::vector<Eigen::Vector3d> sums_;     ///< of these normals
  std::vector<Eigen::Vector3d> way_;
};

Departure departure_of(const TriangleMesh& surface, double thickness, WallSide side) {
  const std::vector<Point> distance = FaceDistances(surface).spread(thickness);
  const double out = side == WallSide::both ? thickness / 2 : 0;
  Departure d;
  for (const double part : {out, out - thickness}) {
    d.from.insert(d.from.end(), surface.points.begin(), surface.points.end());
    for (const Point& n : distance) d.way.push_back({part * n[0], part * n[1], part * n[2]});
  }
  return d;
}

std::vector<char> meeting_triangles(const TriangleMesh& surface) {
  std::vector<char> meets(surface.triangles.size(), 0);
  for (const Meeting& m : self_meetings(surface.triangles, surface.points))
    meets[at(m.first)] = meets[at(m.second)] = 1;
  return meets;
}

}  // namespace

Wall thickened(const TriangleMesh& surface, double thickness, WallSide side) {
  const WallBuilder builder(surface);
  Wall wall;
  wall.mesh.triangles = builder.triangles();
  wall.part = builder.part();
  const Departure departure = departure_of(surface, thickness, side);
  const std::vector<double> share =
      shares_apart(wall.mesh.triangles, departure, builder.marked(meeting_triangles(surface)));
  wall.mesh.points = moved(departure, share);
  wall.mesh.metres_per_unit = surface.metres_per_unit;
  for (const Attribute& a : surface.attributes)
    if (a.name != "normal") wall.mesh.attributes.push_back(builder.attribute(a));
  const std::size_t n = surface.points.size();
  wall.thinnest = thickness;
  for (std::size_t v = 0; v < n; ++v) {
    const double part = side == WallSide::both ? (share[v] + share[n + v]) / 2 : share[n + v];
    wall.thinner += part < 1;
    wall.thinnest = std::min(wall.thinnest, part * thickness);
  }
  return wall;
}

}  // namespace pelage
