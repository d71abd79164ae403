#include "catalog/size_map.h"

#include <algorithm>

#include "base/number.h"
#include "react/place_formula.h"
#include "run/place_fields.h"
#include "shape/normals.h"
#include "shape/refine.h"

namespace pelage {

namespace {

/// Looking closer than this would take longer than it is worth.
constexpr std::size_t most_triangles = 2'000'000;

double smallest_value(const PlaceFormula& formula, const TriangleMesh& mesh, const std::vector<Texture>& textures,
                      std::uint64_t seed) {
  const std::vector<Point> normals = vertex_normals(mesh.triangles, mesh.points);
  VertexAttributes attributes = scalar_attributes(mesh.attributes);
  attributes.merge(texture_values(textures, mesh));
  Places places{.positions = mesh.points, .normals = normals};
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  return std::ranges::min(formula.at(places, seed));
}

bool is_known(const Symbol& s) { return s.kind != Symbol::Kind::curvature && s.name.find('.') == std::string::npos; }

}  // namespace

double smallest_factor(const Stage& stage, const TriangleMesh& shape, const std::vector<Texture>& textures,
                       double edge) {
  if (!stage.size_map || shape.triangles.empty()) return 1;
  const Formula map{stage.size_map->value, stage.size_map->where};
  const PlaceFormula formula(map);
  const std::vector<Symbol> symbols = formula.symbols();
  if (!std::ranges::all_of(symbols, is_known)) return 1;
  const std::vector<Texture> read = textures_read(symbols, textures);
  TriangleMesh mesh = shape;
  double smallest = smallest_value(formula, mesh, read, stage.seed);
  while (!read.empty() && smallest > 0 && prevailing_edge(mesh.triangles, mesh.points) > smallest * edge &&
         4 * mesh.triangles.size() <= most_triangles) {
    mesh = split_at_midpoints(mesh);
    smallest = smallest_value(formula, mesh, read, stage.seed);
  }
  if (!(smallest > 0))
    throw Error(Fault::usage, "the map of the size is " + number(smallest) + " somewhere; it must be greater than 0",
                map.where);
  return smallest;
}

}  // namespace pelage
