#include "catalog/brushes.h"

#include <algorithm>

#include "base/number.h"
#include "catalog/names.h"
#include "pelage/error.h"
#include "shape/normals.h"
#include "shape/refine.h"
#include "shape/stroke.h"

namespace pelage {

namespace {

Attribute painted(const Brush& brush, const ShapeScale& scale, const TriangleMesh& shape,
                  const std::vector<Point>& normals) {
  Attribute a{brush.name.value, 1, Domain::vertex, std::vector<double>(shape.points.size(), 0.0)};
  for (const Brush::Stroke& s : brush.strokes) {
    const std::vector<double> shares =
        stroke_shares({s.points, world_length(s.radius, scale), s.hardness}, shape.points, normals);
    for (std::size_t v = 0; v < shares.size(); ++v) a.values[v] += shares[v] * (s.value - a.values[v]);
  }
  return a;
}

}  // namespace

void paint_brushes(const std::vector<Brush>& brushes, const ShapeScale& scale, bool normals, TriangleMesh& shape) {
  if (brushes.empty()) return;
  const std::vector<Point> sides = normals ? vertex_normals(shape.triangles, shape.points) : std::vector<Point>{};
  for (const Brush& brush : brushes) {
    if (shape.find(brush.name.value))
      throw Error(Fault::usage,
                  "the shape has an attribute \"" + brush.name.value + "\" already; give the brush another name",
                  brush.name.where);
  }
  for (const Brush& brush : brushes) shape.set(painted(brush, scale, shape, sides));
}

std::vector<std::string> coarse_brushes(const std::vector<Brush>& brushes, const ShapeScale& scale,
                                        const TriangleMesh& shape) {
  if (brushes.empty() || shape.triangles.empty()) return {};
  const double edge = prevailing_edge(shape.triangles, shape.points);
  std::vector<std::string> lines;
  for (const Brush& brush : brushes)
    if (std::ranges::any_of(brush.strokes,
                            [&](const Brush::Stroke& s) { return world_length(s.radius, scale) < edge; }))
      lines.push_back("the brush \"" + brush.name.value +
                      "\" has strokes narrower than the triangles of the shape, whose edges of " + number(edge, 3) +
                      " show in it; a finer mesh has smoother strokes");
  return lines;
}

void require_brush_names(const std::vector<Brush>& brushes, const std::vector<std::string>& species) {
  std::vector<std::string> taken = species;
  for (const Brush& brush : brushes) {
    require_name(brush.name);
    if (std::ranges::count(taken, brush.name.value) > 0)
      throw Error(Fault::usage, "\"" + brush.name.value + "\" is taken; give the brush another name", brush.name.where);
    taken.push_back(brush.name.value);
  }
}

}  // namespace pelage
