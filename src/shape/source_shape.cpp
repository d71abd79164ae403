#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "pelage/polygon_mesh.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Corners of faces that were removed take the vertex of another corner at the same vertex or place.
std::vector<std::int32_t> completed(const SourceShape& source) {
  const PolygonMesh& file = source.polygons;
  std::vector<std::int32_t> vertex = source.vertex;
  if (std::ranges::find(vertex, -1) == vertex.end()) return vertex;
  std::map<Point, std::int32_t> at_place;
  for (std::size_t c = 0; c < vertex.size(); ++c)
    if (vertex[c] >= 0) at_place.emplace(file.points[file.corners[c]], vertex[c]);
  for (std::size_t c = 0; c < vertex.size(); ++c) {
    const auto found = vertex[c] < 0 ? at_place.find(file.points[file.corners[c]]) : at_place.end();
    if (found != at_place.end()) vertex[c] = found->second;
  }
  return vertex;
}

/// A vertex of the file that became several, where solids touch, is drawn to their middle.
std::vector<Point> moved_points(const PolygonMesh& file, const std::vector<std::int32_t>& vertex,
                                const std::vector<Point>& points) {
  std::vector<Point> sum(file.points.size(), Point{});
  std::vector<double> count(file.points.size(), 0);
  std::vector<std::int32_t> only(file.points.size(), -1);
  for (std::size_t c = 0; c < vertex.size(); ++c) {
    if (vertex[c] < 0) continue;
    const auto v = static_cast<std::size_t>(file.corners[c]);
    only[v] = count[v] == 0 || only[v] == vertex[c] ? vertex[c] : -1;
    for (std::size_t k = 0; k < 3; ++k) sum[v][k] += points[vertex[c]][k];
    ++count[v];
  }
  std::vector<Point> result = file.points;
  for (std::size_t v = 0; v < result.size(); ++v) {
    if (count[v] == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) result[v][k] = only[v] >= 0 ? points[only[v]][k] : sum[v][k] / count[v];
  }
  return result;
}

Attribute at_corners(const Attribute& a, const std::vector<std::int32_t>& vertex) {
  Attribute result = a;
  result.domain = Domain::corner;
  result.values.assign(vertex.size() * a.components, 0);
  for (std::size_t c = 0; c < vertex.size(); ++c)
    if (vertex[c] >= 0)
      std::copy_n(a.values.begin() + std::ptrdiff_t{vertex[c]} * a.components, a.components,
                  result.values.begin() + static_cast<std::ptrdiff_t>(c) * a.components);
  return result;
}

/// At the vertices of the file if its corners agree there.
Attribute gathered(Attribute corner, const PolygonMesh& file) {
  const std::size_t n = corner.components;
  std::vector<double> values(n * file.points.size(), 0);
  std::vector<char> known(file.points.size(), 0);
  for (std::size_t c = 0; c < file.corners.size(); ++c) {
    const auto v = static_cast<std::size_t>(file.corners[c]);
    const auto from = corner.values.begin() + static_cast<std::ptrdiff_t>(n * c);
    const auto to = values.begin() + static_cast<std::ptrdiff_t>(n * v);
    if (std::exchange(known[v], 1)) {
      if (!std::equal(from, from + corner.components, to)) return corner;
    } else {
      std::copy_n(from, n, to);
    }
  }
  corner.values = std::move(values);
  corner.domain = Domain::vertex;
  return corner;
}

/// Newell's normal of a face: twice the vector of its area.
Point area_normal(const PolygonMesh& mesh, std::size_t f) {
  const std::size_t begin = mesh.face_begin(f), n = mesh.face_size(f);
  Point normal{};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Point& origin = mesh.points[mesh.corners[begin]];
    const Point add = cross(difference(mesh.points[mesh.corners[begin + i]], origin),
                            difference(mesh.points[mesh.corners[begin + i + 1]], origin));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += add[k];
  }
  return normal;
}

/// Corners at one vertex whose normals were equal stay equal: the mean of their faces.
Attribute renewed_normals(const Attribute& old, const PolygonMesh& mesh, const std::vector<std::int32_t>& vertex) {
  using Key = std::pair<std::int32_t, Point>;
  const auto key = [&](std::size_t c) {
    const double* n = old.values.data() + 3 * (old.domain == Domain::corner ? c : mesh.corners[c]);
    return Key{vertex[c], {n[0], n[1], n[2]}};
  };
  std::map<Key, Point> sums;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Point normal = area_normal(mesh, f);
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_ends[f]; ++c)
      for (std::size_t k = 0; k < 3; ++k) sums[key(c)][k] += normal[k];
  }
  Attribute result = old;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const Point n = unit(sums[key(c)]);
    std::copy_n(
        n.begin(), 3,
        result.values.begin() + static_cast<std::ptrdiff_t>(3 * (old.domain == Domain::corner ? c : mesh.corners[c])));
  }
  return result;
}

}  // namespace

PolygonMesh as_in_file(const SourceShape& source, const TriangleMesh& mesh) {
  const std::vector<std::int32_t> vertex = completed(source);
  PolygonMesh result = source.polygons;
  result.metres_per_unit = mesh.metres_per_unit;
  result.points = moved_points(source.polygons, vertex, mesh.points);
  for (const Attribute& a : mesh.attributes)
    if (a.domain == Domain::vertex) result.set(gathered(at_corners(a, vertex), source.polygons));
  const Attribute* normal = source.polygons.find("normal");
  if (normal && normal->components == 3 && !mesh.find("normal") && normal->domain != Domain::face &&
      result.points != source.polygons.points)
    result.set(renewed_normals(*normal, result, vertex));
  return result;
}

}  // namespace pelage
