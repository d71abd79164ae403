#include "look/dress.h"

#include <algorithm>
#include <utility>

namespace pelage {

namespace {

std::vector<double> flattened(const std::vector<Point>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Point& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

/// "STAGE.SPECIES" as file formats like it.
std::string attribute_name(std::string field) {
  std::ranges::replace(field, '.', '_');
  return field;
}

}  // namespace

TriangleMesh dress(Tessellation t, const Paint& paint, const std::vector<char>& uniform) {
  std::vector<double> color = pelage::paint(t.samples, make_palette(paint, t.samples, uniform));
  TriangleMesh mesh{std::move(t.samples.position), std::move(t.triangles), {}};
  mesh.set({"normal", 3, Domain::vertex, flattened(t.samples.normal)});
  mesh.set({"color", 3, Domain::vertex, std::move(color)});
  for (std::size_t i = 0; i < t.samples.fields.size(); ++i)
    mesh.set({attribute_name(paint.species[i]), 1, Domain::vertex, std::move(t.samples.fields[i])});
  for (Attribute& a : t.attributes) mesh.set(std::move(a));
  return mesh;
}

TriangleMesh dress(const CoatFields& fields, const Look& look) {
  const Paint paint = resolve_paint(look, fields.species);
  return dress(tessellate(fields, tessellation_request(look, paint)), paint, fields.uniform);
}

}  // namespace pelage
