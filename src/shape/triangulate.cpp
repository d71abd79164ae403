#include "shape/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "shape/places.h"

namespace pelage {

namespace {

using Flat = std::array<double, 2>;

double cross(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double squared_distance(const Flat& a, const Flat& b) {
  return (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
}

/// Signed area over the sum of the squared sides: positive if counter-clockwise, largest for equal angles.
double quality(const Flat& a, const Flat& b, const Flat& c) {
  const double sides = squared_distance(a, b) + squared_distance(b, c) + squared_distance(c, a);
  return sides > 0 ? cross(a, b, c) / sides : 0;
}

/// Newell's normal of a closed polygon: twice the vector of its area.
Point newell_normal(const std::vector<Point>& ring) {
  Point n{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    for (int k = 0; k < 3; ++k) n[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  return n;
}

/// The ring seen from the tip of its normal: orthonormal coordinates in its mean plane.
std::vector<Flat> flatten(const std::vector<Point>& ring) {
  Point n = newell_normal(ring);
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return std::vector<Flat>(ring.size(), Flat{});
  for (double& x : n) x /= length;
  const int least = static_cast<int>(
      std::min_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - n.begin());
  Point u{};
  u[least] = 1;
  for (int k = 0; k < 3; ++k) u[k] -= n[least] * n[k];
  const double u_length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  for (double& x : u) x /= u_length;
  const Point v = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  std::vector<Flat> flat;
  flat.reserve(ring.size());
  for (const Point& p : ring)
    flat.push_back({u[0] * p[0] + u[1] * p[1] + u[2] * p[2], v[0] * p[0] + v[1] * p[1] + v[2] * p[2]});
  return flat;
}

/// Clips ears off one flat polygon; emits triples of positions in the ring.
class EarClipper {
 public:
  EarClipper(const std::vector<Flat>& points, const std::vector<char>& keep)
      : points_(points), keep_(keep), next_(points.size()), previous_(points.size()), score_(points.size()) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    for (std::size_t i = 0; i < n; ++i)
      if (corner_quality(i) <= 0) reflex_.push_back(i);
    for (std::size_t i = 0; i < n; ++i) score_[i] = ear_score(i);
  }

  /// Returns false if the polygon crosses itself, so that some triangle had to be forced.
  template <class Emit>
  bool run(Emit&& emit) {
    bool clean = true;
    std::size_t start = 0;
    for (std::size_t left = points_.size(); left > 3; --left) {
      const std::size_t ear = best_ear(start, left);
      clean = clean && score_[ear] >= 0;
      emit(previous_[ear], ear, next_[ear]);
      start = clip(ear);
    }
    emit(previous_[start], start, next_[start]);
    return clean && corner_quality(start) >= 0;
  }

 private:
  double corner_quality(std::size_t i) const { return quality(points_[previous_[i]], points_[i], points_[next_[i]]); }

  bool blocks(std::size_t r, const Flat& a, const Flat& b, const Flat& c) const {
    const Flat& p = points_[r];
    if (p == a || p == b || p == c) return false;  // the bridges of polygons with holes pass twice through a point
    return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
  }

  /// The quality of an ear; negative, the worse the more, where the corner is none. Corners to keep are the last
  /// resort among the ears, as are flat corners, which give triangles without area.
  double ear_score(std::size_t i) const {
    const double q = corner_quality(i);
    if (q < 0) return q - 1;
    const Flat &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    for (std::size_t r : reflex_)
      if (r != i && r != previous_[i] && r != next_[i] && blocks(r, a, b, c)) return q - 1;
    return keep_[i] ? 0 : q;
  }

  std::size_t best_ear(std::size_t start, std::size_t left) const {
    std::size_t best = start;
    for (std::size_t i = start; left > 0; --left, i = next_[i])
      if (score_[i] > score_[best]) best = i;
    return best;
  }

  /// Takes the corner out; returns one that remains.
  std::size_t clip(std::size_t i) {
    const std::size_t p = previous_[i], n = next_[i];
    next_[p] = n;
    previous_[n] = p;
    std::erase_if(reflex_, [&](std::size_t r) { return r == i || ((r == p || r == n) && corner_quality(r) > 0); });
    score_[p] = ear_score(p);
    score_[n] = ear_score(n);
    return p;
  }

  const std::vector<Flat>& points_;
  const std::vector<char>& keep_;  // corners that should not become ears
  std::vector<std::size_t> next_, previous_, reflex_;
  std::vector<double> score_;
};

/// Positions in the ring of the two triangles of a quad. The diagonal 0-2 wins ties; corners to keep decide first.
std::array<std::array<std::size_t, 3>, 2> cut_quad(const std::vector<Flat>& q, const std::vector<char>& keep) {
  const double along_02 = std::min(quality(q[0], q[1], q[2]), quality(q[0], q[2], q[3]));
  const double along_13 = std::min(quality(q[1], q[2], q[3]), quality(q[1], q[3], q[0]));
  // Rounding, that of floats far from the origin too, must not choose between the diagonals of a square.
  constexpr double tie = 1e-4;
  const bool keep_02 = keep[0] || keep[2], keep_13 = keep[1] || keep[3];
  if (keep_13 != keep_02 ? keep_13 : along_13 > along_02 + tie) return {{{1, 2, 3}, {1, 3, 0}}};
  return {{{0, 1, 2}, {0, 2, 3}}};
}

/// Marks the vertices inside the surface where only two faces meet. An ear of both faces there would make the same
/// triangle twice, back to back.
std::vector<char> vertices_of_two_faces(const PolygonMesh& polygons) {
  struct Fan {
    std::int32_t before = -1, after = -1, faces = 0;
  };
  const std::size_t vertices = polygons.points.size();
  std::vector<char> marked(vertices, 0);
  if (polygons.corners.size() == 3 * polygons.face_count()) return marked;
  const std::vector<std::int32_t> place = same_places(polygons.points, std::vector<char>(vertices, 1));
  std::vector<Fan> fans(vertices);
  for (std::size_t f = 0; f < polygons.face_count(); ++f) {
    const std::size_t begin = polygons.face_begin(f), end = polygons.face_ends[f];
    for (std::size_t c = begin; c < end; ++c) {
      const std::int32_t v = place[polygons.corners[c]];
      const std::int32_t before = place[polygons.corners[c == begin ? end - 1 : c - 1]];
      const std::int32_t after = place[polygons.corners[c + 1 == end ? begin : c + 1]];
      Fan& fan = fans[v];
      marked[v] = ++fan.faces == 2 && fan.before == after && fan.after == before;
      if (fan.faces == 1) fan = {before, after, 1};
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) marked[v] = marked[place[v]];
  return marked;
}

/// Collects the triangles of all faces as corner numbers of the polygon mesh.
class FaceCutter {
 public:
  explicit FaceCutter(const PolygonMesh& polygons) : polygons_(polygons), keep_(vertices_of_two_faces(polygons)) {}

  void cut(std::size_t face) {
    const std::size_t begin = polygons_.face_begin(face), n = polygons_.face_ends[face] - begin;
    auto emit = [&](std::size_t a, std::size_t b, std::size_t c) { add(face, begin + a, begin + b, begin + c); };
    if (n == 3) return emit(0, 1, 2);
    const std::vector<Flat> flat = flatten(ring(begin, n));
    std::vector<char> keep(n);
    for (std::size_t i = 0; i < n; ++i) keep[i] = keep_[polygons_.corners[begin + i]];
    if (n == 4) {
      for (const auto& t : cut_quad(flat, keep)) emit(t[0], t[1], t[2]);
    } else if (!EarClipper(flat, keep).run(emit) && crossing_count_++ == 0) {
      first_crossing_ = face;
    }
  }

  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::int32_t> source_face;

  void report(std::vector<Finding>& findings) const {
    if (crossing_count_ == 0) return;
    findings.push_back({"crossing-faces",
                        counted(crossing_count_, "face") + " that cross themselves (first: face " +
                            std::to_string(first_crossing_) + "); some of their triangles are folded over",
                        crossing_count_, first_crossing_, false});
  }

 private:
  void add(std::size_t face, std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({a, b, c});
    source_face.push_back(static_cast<std::int32_t>(face));
  }

  /// The corners' points relative to the first, which keeps their differences exact far from the origin.
  std::vector<Point> ring(std::size_t begin, std::size_t n) const {
    const Point& origin = polygons_.points[polygons_.corners[begin]];
    std::vector<Point> points(n);
    for (std::size_t i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) points[i][k] = polygons_.points[polygons_.corners[begin + i]][k] - origin[k];
    return points;
  }

  const PolygonMesh& polygons_;
  std::vector<char> keep_;  // per vertex: should not be cut off as an ear
  std::size_t crossing_count_ = 0, first_crossing_ = 0;
};

constexpr std::size_t most_corners = 20000;
constexpr std::size_t most_triangles = std::numeric_limits<std::int32_t>::max() / 3;

void check_face(const PolygonMesh& polygons, std::size_t face) {
  const std::size_t begin = polygons.face_begin(face), end = polygons.face_ends[face];
  for (std::size_t c = begin; c < end; ++c) {
    const std::int32_t v = polygons.corners[c];
    if (v < 0 || static_cast<std::size_t>(v) >= polygons.points.size())
      throw ShapeFault(ShapeFault::Element::face, face,
                       "refers to vertex " + std::to_string(v) + ", but the vertices are 0 to " +
                           std::to_string(static_cast<std::int64_t>(polygons.points.size()) - 1) +
                           "; correct the file");
  }
  if (end - begin > most_corners)
    throw ShapeFault(ShapeFault::Element::face, face,
                     "has " + std::to_string(end - begin) + " corners; at most " + std::to_string(most_corners) +
                         " can be triangulated, cut it in the modelling program");
}

/// Upper bound of the number of triangles, for the memory; checks the limit on the way.
std::size_t count_triangles(const PolygonMesh& polygons) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < polygons.face_count(); ++f) {
    const std::size_t n = polygons.face_ends[f] - polygons.face_begin(f);
    count += n < 3 ? 0 : n - 2;
  }
  if (count > most_triangles ||
      polygons.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw ShapeFault(ShapeFault::Element::none, 0,
                     "the mesh has " + std::to_string(polygons.points.size()) + " vertices and " +
                         std::to_string(count) + " triangles; at most 2147483647 and " +
                         std::to_string(most_triangles) + " can be used");
  return count;
}

std::vector<double> pick_corners(const Attribute& attribute, const std::vector<std::array<std::size_t, 3>>& triangles) {
  std::vector<double> values;
  values.reserve(3 * triangles.size() * attribute.components);
  for (const auto& t : triangles)
    for (std::size_t c : t) {
      const auto first = attribute.values.begin() + static_cast<std::ptrdiff_t>(c * attribute.components);
      values.insert(values.end(), first, first + attribute.components);
    }
  return values;
}

std::vector<double> pick_faces(const Attribute& attribute, const std::vector<std::int32_t>& faces) {
  std::vector<double> values;
  values.reserve(faces.size() * attribute.components);
  for (const std::int32_t f : faces) {
    const auto first = attribute.values.begin() + std::ptrdiff_t{f} * attribute.components;
    values.insert(values.end(), first, first + attribute.components);
  }
  return values;
}

}  // namespace

Triangulation triangulate(PolygonMesh polygons, std::vector<Finding>& findings) {
  const std::size_t count = count_triangles(polygons);
  for (std::size_t f = 0; f < polygons.face_count(); ++f) check_face(polygons, f);
  FaceCutter cutter(polygons);
  cutter.triangles.reserve(count);
  cutter.source_face.reserve(count);
  Finding small{"small-faces", "", 0, 0, true};
  for (std::size_t f = 0; f < polygons.face_count(); ++f) {
    if (polygons.face_ends[f] - polygons.face_begin(f) >= 3)
      cutter.cut(f);
    else if (small.count++ == 0)
      small.element = f;
  }
  if (small.count > 0) {
    small.text = counted(small.count, "face") + " with fewer than three corners (first: face " +
                 std::to_string(small.element) + "); left out";
    findings.push_back(small);
  }
  cutter.report(findings);

  Triangulation result;
  result.source_face = std::move(cutter.source_face);
  result.mesh.triangles.reserve(cutter.triangles.size());
  for (const auto& [a, b, c] : cutter.triangles)
    result.mesh.triangles.push_back({polygons.corners[a], polygons.corners[b], polygons.corners[c]});
  for (Attribute& attribute : polygons.attributes) {
    if (attribute.domain == Domain::corner) attribute.values = pick_corners(attribute, cutter.triangles);
    if (attribute.domain == Domain::face) attribute.values = pick_faces(attribute, result.source_face);
    result.mesh.set(std::move(attribute));
  }
  result.mesh.links = std::move(polygons.links);
  result.mesh.metres_per_unit = polygons.metres_per_unit;
  result.mesh.points = std::move(polygons.points);
  return result;
}

}  // namespace pelage
