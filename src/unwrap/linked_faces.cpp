#include "unwrap/linked_faces.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/box.h"
#include "shape/edges.h"
#include "shape/places.h"
#include "shape/triangulate.h"
#include "shape/vectors.h"
#include "unwrap/chart.h"

namespace pelage {

namespace {

/// Triangles whose corners know where they stand in the file.
Triangulation with_corners(const PolygonMesh& polygons, std::vector<Finding>& findings) {
  PolygonMesh bare{polygons.points, polygons.corners, polygons.face_ends, {}, {}};
  Attribute number{"corner", 1, Domain::corner, {}};
  for (std::size_t c = 0; c < bare.corners.size(); ++c) number.values.push_back(static_cast<double>(c));
  bare.set(std::move(number));
  return triangulate(std::move(bare), findings);
}

/// Exactly, so that neither the unit nor the size of a shape changes any bit.
double unit_scale(const std::vector<Point>& points) {
  for (const Point& p : points)
    if (!std::isfinite(p[0] + p[1] + p[2]))
      throw Error(Fault::input, "a vertex is not at a finite place; correct the file");
  const double size = box_of(points).diagonal();
  return size > 0 ? std::exp2(-std::ilogb(size)) : 1;
}

struct Side {
  std::int32_t low, high;  ///< places
  std::int32_t inside;     ///< of a diagonal its face, else -1: diagonals link within their face alone
  std::int32_t halfedge;
};

class Linker {
 public:
  Linker(const PolygonMesh& polygons, const LinkedFaces& faces) : polygons_(polygons), faces_(faces) {}

  std::vector<std::int32_t> twins() const {
    std::vector<Side> sides = sorted_sides();
    std::vector<std::int32_t> twin(sides.size(), -1);
    const auto same = [](const Side& a, const Side& b) {
      return a.low == b.low && a.high == b.high && a.inside == b.inside;
    };
    for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
      for (end = k + 1; end < sides.size() && same(sides[k], sides[end]);) ++end;
      const HalfEdge a = sides[k].halfedge, b = sides[end - 1].halfedge;
      if (end - k != 2 || tail(faces_.triangles, a) != tip(faces_.triangles, b)) continue;
      twin[a] = b;
      twin[b] = a;
    }
    return twin;
  }

 private:
  bool is_diagonal(HalfEdge h) const {
    const auto f = static_cast<std::size_t>(faces_.face[h / 3]);
    const auto first = static_cast<std::int32_t>(polygons_.face_begin(f));
    const auto size = static_cast<std::int32_t>(polygons_.face_size(f));
    return (faces_.corner[h] - first + 1) % size != faces_.corner[next_in_face(h)] - first;
  }
  std::vector<Side> sorted_sides() const {
    std::vector<Side> sides;
    for (HalfEdge h = 0; h < std::ssize(faces_.corner); ++h) {
      const auto [low, high] = std::minmax({tail(faces_.triangles, h), tip(faces_.triangles, h)});
      sides.push_back({low, high, is_diagonal(h) ? faces_.face[h / 3] : -1, h});
    }
    std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.inside, s.halfedge); });
    return sides;
  }

  const PolygonMesh& polygons_;
  const LinkedFaces& faces_;
};

/// Nothing but rounding: the sine of the largest angle.
constexpr double flat_sine = 1e-9;

bool is_degenerate(const std::vector<Point>& points, const Triangle& t) {
  const Point a = difference(points[t[1]], points[t[0]]), b = difference(points[t[2]], points[t[0]]);
  const Point c = difference(points[t[2]], points[t[1]]);
  return length(cross(a, b)) <= flat_sine * std::max({dot(a, a), dot(b, b), dot(c, c)});
}

void note_degenerate(std::size_t count, std::int32_t first, std::vector<Finding>& findings) {
  if (count == 0) return;
  findings.push_back({"faces-without-area",
                      counted(count, "triangle") + " without area (first: of face " + std::to_string(first) +
                          "); a line of the atlas stands for each",
                      count, static_cast<std::size_t>(first), false});
}

/// Faces that are no discs, as where a corner comes twice, are cut into their triangles.
void take_odd_faces_apart(LinkedFaces& faces) {
  std::int32_t number = 0;
  for (std::size_t begin = 0, end = 0; begin < faces.face.size(); begin = end) {
    std::vector<std::int32_t> source;
    for (; end < faces.face.size() && faces.face[end] == faces.face[begin]; ++end)
      source.push_back(static_cast<std::int32_t>(end));
    const bool disc = source.size() == 1 || is_disc(make_chart(faces, source, [](HalfEdge) { return true; }));
    for (std::size_t t = begin; t < end; ++t) faces.whole.push_back(disc ? number : number++);
    number += disc ? 1 : 0;
    if (disc) continue;
    for (std::size_t h = 3 * begin; h < 3 * end; ++h) {
      const std::int32_t other = faces.twin[h];
      if (other >= 0 && faces.face[other / 3] == faces.face[begin]) faces.twin[h] = faces.twin[other] = -1;
    }
  }
}

}  // namespace

LinkedFaces link_faces(const PolygonMesh& polygons, std::vector<Finding>& findings) {
  const Triangulation cut = with_corners(polygons, findings);
  const Attribute& number = *cut.mesh.find("corner");
  LinkedFaces result;
  result.scale = unit_scale(polygons.points);
  result.points = polygons.points;
  for (Point& p : result.points)
    for (double& x : p) x *= result.scale;
  result.place = same_places(result.points, std::vector<char>(result.points.size(), 1));
  std::size_t degenerate = 0;
  std::int32_t first = 0;
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t) {
    Triangle places = cut.mesh.triangles[t];
    for (std::int32_t& v : places) v = result.place[v];
    if (is_degenerate(result.points, places) && degenerate++ == 0) first = cut.source_face[t];
    if (places[0] == places[1] || places[1] == places[2] || places[2] == places[0]) continue;
    result.triangles.push_back(places);
    result.face.push_back(cut.source_face[t]);
    for (std::size_t k = 0; k < 3; ++k) result.corner.push_back(static_cast<std::int32_t>(number.values[3 * t + k]));
  }
  if (result.triangles.empty()) throw Error(Fault::input, "the mesh has no faces to unwrap");
  note_degenerate(degenerate, first, findings);
  result.twin = Linker(polygons, result).twins();
  take_odd_faces_apart(result);
  return result;
}

}  // namespace pelage
