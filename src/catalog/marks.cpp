#include "catalog/marks.h"

#include <algorithm>

#include "base/box.h"
#include "base/number.h"
#include "pelage/error.h"
#include "run/material.h"
#include "shape/normals.h"
#include "shape/refine.h"

namespace pelage {

namespace {

/// Looking closer than this would take longer than it is worth.
constexpr std::size_t most_triangles = 2'000'000;

}  // namespace

std::vector<double> vertex_values(const PlaceFormula& formula, const MeshPlaces& m) {
  const std::vector<Point> normals = vertex_normals(m.shape);
  VertexAttributes attributes = scalar_attributes(m.shape);
  attributes.merge(texture_values(textures_read(formula.symbols(), m.textures), m.shape));
  Places places{.positions = m.shape.points, .normals = normals};
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  places.length_unit = m.length_unit;
  places.origin = box_of(m.shape.points).middle();
  return formula.at(places, m.seed);
}

std::vector<Index> marked_vertices(const PlaceFormula& formula, const MeshPlaces& places, const Location& where) {
  const std::vector<double> values = vertex_values(formula, places);
  std::vector<Index> vertices;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (values[v] != 0) vertices.push_back(static_cast<Index>(v));
  if (vertices.empty()) throw Error(Fault::usage, "this marks no vertex of the shape", where);
  return vertices;
}

double smallest_factor(const PlaceFormula& formula, const MeshPlaces& places, double edge, const Location& where) {
  const bool detailed = !textures_read(formula.symbols(), places.textures).empty();
  TriangleMesh mesh = places.shape;
  const MeshPlaces fine{mesh, places.textures, places.length_unit, places.seed};
  double smallest = std::ranges::min(vertex_values(formula, fine));
  while (detailed && smallest > 0 && prevailing_edge(mesh.triangles, mesh.points) > smallest * edge &&
         4 * mesh.triangles.size() <= most_triangles) {
    mesh = split_at_midpoints(mesh);
    smallest = std::ranges::min(vertex_values(formula, fine));
  }
  if (!(smallest > 0))
    throw Error(Fault::usage, "the map of the size is " + number(smallest) + " somewhere; it must be greater than 0",
                where);
  return smallest;
}

}  // namespace pelage
