#include "shape/split_corners.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace pelage {

namespace {

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

}  // namespace

CornerSplit find_split(const TriangleMesh& mesh, const std::vector<const Attribute*>& corner_attributes) {
  CornerSplit split;
  split.triangles = mesh.triangles;
  split.vertex.resize(mesh.points.size());
  std::iota(split.vertex.begin(), split.vertex.end(), 0);
  split.corner.assign(mesh.points.size(), -1);
  std::vector<std::int32_t> next(mesh.points.size(), -1);
  std::int32_t corner = 0;
  for (Triangle& triangle : split.triangles)
    for (std::int32_t& v : triangle) v = place_corner(split, next, corner_attributes, v, corner++);
  return split;
}

Attribute split_attribute(const Attribute& attribute, const CornerSplit& split) {
  Attribute result{attribute.name, attribute.components, Domain::vertex, {}};
  const std::int64_t components = attribute.components;
  result.values.resize(components * split.vertex.size());
  const std::vector<std::int32_t>& source = attribute.domain == Domain::corner ? split.corner : split.vertex;
  for (std::size_t s = 0; s < source.size(); ++s) {
    if (source[s] < 0) continue;
    assert((source[s] + 1) * components <= std::ssize(attribute.values));
    std::copy_n(attribute.values.begin() + components * source[s], components, result.values.begin() + components * s);
  }
  return result;
}

TriangleMesh split_corners(const TriangleMesh& mesh) {
  std::vector<const Attribute*> corner_attributes;
  for (const Attribute& attribute : mesh.attributes)
    if (attribute.domain == Domain::corner) corner_attributes.push_back(&attribute);
  if (corner_attributes.empty()) return mesh;
  const CornerSplit split = find_split(mesh, corner_attributes);
  TriangleMesh result;
  for (std::int32_t v : split.vertex) result.points.push_back(mesh.points[v]);
  result.triangles = split.triangles;
  for (const Attribute& attribute : mesh.attributes) result.attributes.push_back(split_attribute(attribute, split));
  return result;
}

}  // namespace pelage
