#include "catalog/size_map.h"

#include <algorithm>

#include "base/number.h"
#include "catalog/vertex_values.h"
#include "run/place_fields.h"
#include "shape/refine.h"

namespace pelage {

namespace {

/// Looking closer than this would take longer than it is worth.
constexpr std::size_t most_triangles = 2'000'000;

}  // namespace

double smallest_factor(const Stage& stage, const TriangleMesh& shape, const std::vector<Texture>& textures,
                       double edge) {
  if (!stage.size_map || shape.triangles.empty()) return 1;
  const PlaceFormula formula({stage.size_map->value, stage.size_map->where});
  if (!known_from_mesh(formula)) return 1;
  const std::vector<Texture> read = textures_read(formula.symbols(), textures);
  TriangleMesh mesh = shape;
  double smallest = std::ranges::min(vertex_values(formula, mesh, read, stage.seed));
  while (!read.empty() && smallest > 0 && prevailing_edge(mesh.triangles, mesh.points) > smallest * edge &&
         4 * mesh.triangles.size() <= most_triangles) {
    mesh = split_at_midpoints(mesh);
    smallest = std::ranges::min(vertex_values(formula, mesh, read, stage.seed));
  }
  if (!(smallest > 0))
    throw Error(Fault::usage, "the map of the size is " + number(smallest) + " somewhere; it must be greater than 0",
                stage.size_map->where);
  return smallest;
}

}  // namespace pelage
