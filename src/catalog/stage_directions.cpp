#include "catalog/stage_directions.h"

#include "catalog/vertex_values.h"
#include "run/place_fields.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// The vertices where a formula is not 0.
std::vector<Index> marked(const Given<std::string>& text, const TriangleMesh& shape,
                          const std::vector<Texture>& textures, std::uint64_t seed) {
  const PlaceFormula formula({text.value, text.where});
  if (!known_from_mesh(formula))
    throw Error(Fault::usage, "what marks vertices cannot depend on curvatures or on earlier stages", text.where);
  if (shape.triangles.empty()) return {};
  const std::vector<double> values = vertex_values(formula, shape, textures_read(formula.symbols(), textures), seed);
  std::vector<Index> vertices;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (values[v] != 0) vertices.push_back(static_cast<Index>(v));
  if (vertices.empty()) throw Error(Fault::usage, "this marks no vertex of the shape", text.where);
  return vertices;
}

}  // namespace

FieldWish resolve_directions(const Stage& stage, const Model& model, const TriangleMesh& shape,
                             const std::vector<Texture>& textures, double diagonal) {
  const Directions& d = *stage.directions;
  if (!model.anisotropic())
    throw Error(Fault::usage, "model \"" + model.name() + "\" diffuses the same in all directions", d.where);
  if (d.axis && length(*d.axis) == 0) throw Error(Fault::usage, "the axis has length 0", d.where);
  FieldWish wish;
  wish.axis = d.axis;
  wish.curvature = d.curvature;
  wish.strokes = d.strokes;
  if (d.from) {
    wish.from = marked(*d.from, shape, textures, stage.seed);
    wish.to = marked(*d.to, shape, textures, stage.seed);
  }
  wish.across = d.across;
  wish.smooth = default_field_smoothing * diagonal;
  return wish;
}

}  // namespace pelage
