#include "shape/split_corners.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace pelage {

namespace {

/// Which vertices there are once the vertices of a mesh are split.
struct CornerSplit {
  std::vector<std::int32_t> corners;  ///< those of the mesh in numbers of split vertices
  std::vector<std::int32_t> vertex;   ///< per split vertex: the vertex of the mesh that it comes from
  std::vector<std::int32_t> corner;   ///< per split vertex: a corner that carries its values, -1 if no face has it
};

bool same_values(const std::vector<const Attribute*>& attributes, std::int32_t corner_a, std::int32_t corner_b) {
  return std::all_of(attributes.begin(), attributes.end(), [&](const Attribute* attribute) {
    const auto a = attribute->values.begin() + std::int64_t{attribute->components} * corner_a;
    const auto b = attribute->values.begin() + std::int64_t{attribute->components} * corner_b;
    return std::equal(a, a + attribute->components, b);
  });
}

/// Finds or makes the split vertex of one corner; `next` chains the split vertices of one vertex.
std::int32_t place_corner(CornerSplit& split, std::vector<std::int32_t>& next,
                          const std::vector<const Attribute*>& attributes, std::int32_t vertex, std::int32_t corner) {
  std::int32_t s = vertex;
  if (split.corner[s] < 0) split.corner[s] = corner;
  while (!same_values(attributes, split.corner[s], corner)) {
    if (next[s] < 0) {
      next[s] = static_cast<std::int32_t>(split.vertex.size());
      split.vertex.push_back(vertex);
      split.corner.push_back(corner);
      next.push_back(-1);
    }
    s = next[s];
  }
  return s;
}

CornerSplit find_split(const PolygonMesh& mesh, const std::vector<const Attribute*>& corner_attributes) {
  CornerSplit split;
  split.corners = mesh.corners;
  split.vertex.resize(mesh.points.size());
  std::iota(split.vertex.begin(), split.vertex.end(), 0);
  split.corner.assign(mesh.points.size(), -1);
  std::vector<std::int32_t> next(mesh.points.size(), -1);
  std::int32_t corner = 0;
  for (std::int32_t& v : split.corners) v = place_corner(split, next, corner_attributes, v, corner++);
  return split;
}

void split_attribute(Attribute& attribute, const CornerSplit& split) {
  if (attribute.domain == Domain::face) return;
  const std::int64_t components = attribute.components;
  std::vector<double> values(components * split.vertex.size());
  const std::vector<std::int32_t>& source = attribute.domain == Domain::corner ? split.corner : split.vertex;
  for (std::size_t s = 0; s < source.size(); ++s) {
    if (source[s] < 0) continue;
    assert((source[s] + 1) * components <= std::ssize(attribute.values));
    std::copy_n(attribute.values.begin() + components * source[s], components, values.begin() + components * s);
  }
  attribute.values = std::move(values);
  attribute.domain = Domain::vertex;
}

}  // namespace

PolygonMesh split_corners(PolygonMesh mesh) {
  std::vector<const Attribute*> corner_attributes;
  for (const Attribute& attribute : mesh.attributes)
    if (attribute.domain == Domain::corner) corner_attributes.push_back(&attribute);
  if (corner_attributes.empty()) return mesh;
  CornerSplit split = find_split(mesh, corner_attributes);
  std::vector<Point> points;
  points.reserve(split.vertex.size());
  for (std::int32_t v : split.vertex) points.push_back(mesh.points[v]);
  for (Attribute& attribute : mesh.attributes) split_attribute(attribute, split);
  mesh.points = std::move(points);
  mesh.corners = std::move(split.corners);
  return mesh;
}

TriangleMesh split_corners(const TriangleMesh& mesh) {
  PolygonMesh split = split_corners(polygons_of(mesh));
  TriangleMesh result{std::move(split.points), {}, std::move(split.attributes), mesh.links, mesh.metres_per_unit};
  result.triangles.reserve(mesh.triangles.size());
  for (std::size_t c = 0; c < split.corners.size(); c += 3)
    result.triangles.push_back({split.corners[c], split.corners[c + 1], split.corners[c + 2]});
  return result;
}

}  // namespace pelage
