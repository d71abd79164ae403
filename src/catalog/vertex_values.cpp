#include "catalog/vertex_values.h"

#include <algorithm>

#include "run/place_fields.h"
#include "shape/normals.h"

namespace pelage {

bool known_from_mesh(const PlaceFormula& formula) {
  return std::ranges::all_of(formula.symbols(), [](const Symbol& s) {
    return s.kind != Symbol::Kind::curvature && s.name.find('.') == std::string::npos;
  });
}

std::vector<double> vertex_values(const PlaceFormula& formula, const TriangleMesh& mesh,
                                  const std::vector<Texture>& textures, std::uint64_t seed) {
  const std::vector<Point> normals = vertex_normals(mesh.triangles, mesh.points);
  VertexAttributes attributes = scalar_attributes(mesh.attributes);
  attributes.merge(texture_values(textures, mesh));
  Places places{.positions = mesh.points, .normals = normals};
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  return formula.at(places, seed);
}

}  // namespace pelage
