#include "run/place_fields.h"

#include <algorithm>

#include "discretise/sampling.h"
#include "react/place_values.h"
#include "shape/refine.h"

namespace pelage {

namespace {

bool reads_curvature(const Model& model) {
  const std::vector<Symbol> symbols = place_symbols(model);
  return std::any_of(symbols.begin(), symbols.end(), [](const Symbol& s) { return s.kind == Symbol::Kind::curvature; });
}

std::vector<double> at_quadrature_points(const Discretisation& d, const std::vector<double>& at_vertices) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(d.first_point.back()));
  for (std::size_t e = 0; e < d.elements(); ++e) {
    const Triangle& t = d.topology.triangles[e];
    const auto corner = [&](std::size_t k) { return at_vertices[static_cast<std::size_t>(t[k])]; };
    for (const auto& [v, w] : d.classes[static_cast<std::size_t>(d.element_class[e])].place)
      values.push_back((1 - v - w) * corner(0) + v * corner(1) + w * corner(2));
  }
  return values;
}

}  // namespace

VertexAttributes attributes_read(const Model& model, const TriangleMesh& mesh) {
  const VertexAttributes all = scalar_attributes(mesh.attributes);
  VertexAttributes read;
  for (const Symbol& s : place_symbols(model))
    if (const auto found = all.find(s.name); s.kind == Symbol::Kind::attribute && found != all.end())
      read.insert(*found);
  return read;
}

std::vector<Texture> textures_read(const std::vector<Symbol>& symbols, const std::vector<Texture>& textures) {
  std::vector<Texture> read;
  for (const Texture& texture : textures) {
    const auto names = attribute_names(texture.name);
    if (std::ranges::any_of(symbols, [&](const Symbol& s) {
          return s.kind == Symbol::Kind::attribute && std::ranges::count(names, s.name) > 0;
        }))
      read.push_back(texture);
  }
  return read;
}

VertexAttributes texture_values(const std::vector<Texture>& textures, const TriangleMesh& mesh) {
  VertexAttributes values;
  for (const Texture& texture : textures)
    values.merge(texture_attributes(texture, mesh.triangles, mesh.points.size(), *mesh.find("uv")));
  return values;
}

VertexAttributes refined_textures(const Model& model, const std::vector<Texture>& textures, const TriangleMesh& mesh,
                                  int levels) {
  const std::vector<Texture> read = textures_read(place_symbols(model), textures);
  if (read.empty()) return {};
  TriangleMesh fine{mesh.points, mesh.triangles, {*mesh.find("uv")}};
  for (int level = 0; level < levels; ++level) fine = split_at_midpoints(fine);
  return texture_values(read, fine);
}

VertexAttributes refined(const TriangleMesh& mesh, VertexAttributes attributes, int levels) {
  if (attributes.empty()) return attributes;
  Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  for (int level = 0; level < levels; ++level) {
    const Refinement fine = midpoint_refine(topology);
    for (auto& [name, values] : attributes) values = combine(fine.stencils, values);
    topology = make_topology(fine.stencils.rows(), fine.triangles);
  }
  return attributes;
}

Places PlaceFields::places(double length_unit) const {
  Places places{.positions = position, .normals = normal, .k1 = curvature.k1, .k2 = curvature.k2};
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  places.length_unit = length_unit;
  return places;
}

PlaceFields vertex_fields(const Model& model, const Discretisation& d, const std::vector<Point>& control,
                          VertexAttributes attributes) {
  PlaceFields fields{limit_positions(d, control), limit_normals(d, control), {}, std::move(attributes)};
  if (reads_curvature(model)) fields.curvature = principal_curvatures(vertex_curvature(d, control), fields.normal);
  return fields;
}

PlaceFields quadrature_fields(const Model& model, const Discretisation& d, const std::vector<Point>& control,
                              const VertexAttributes& attributes) {
  QuadratureGeometry g = quadrature_geometry(d, control);
  PlaceFields fields{std::move(g.position), std::move(g.normal), {}, attributes};
  if (reads_curvature(model)) fields.curvature = principal_curvatures(quadrature_curvature(d, control), fields.normal);
  for (auto& [name, values] : fields.attributes) values = at_quadrature_points(d, values);
  return fields;
}

}  // namespace pelage
