#include "catalog/size.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.h"
#include "base/length_unit.h"
#include "base/number.h"
#include "shape/grid.h"
#include "shape/refine.h"
#include "shape/tet_mesh.h"

namespace pelage {

namespace {

/// Both readings, so that one of them can be chosen.
[[noreturn]] void refuse_unknown_unit(const Given<Length>& length, const ShapeScale& scale) {
  const std::string across = number(scale.longest);
  throw Error(Fault::usage,
              "a length of " + length_in_words(length.value.value) +
                  " needs the unit of the shape, which its file does not say: it is " + across + " units across, " +
                  across + " m or " + across + " mm; give --input-unit m or --input-unit mm",
              length.where);
}

struct NodeDistance {
  const TriangleMesh& mesh;
  double operator()(const Grid& grid) const { return mean_edge(grid); }
  double operator()(const Atlas&) const { return prevailing_edge(mesh.triangles, mesh.points); }
  // Within that radius of a point lie about 4 pi others (Turk 1991, section 4.1).
  double operator()(const Cells& cells) const { return std::sqrt(std::numbers::inv_sqrt3 / 2) * cells.radius; }
  double operator()(const TetMesh& volume) const { return mean_edge(volume); }
};

}  // namespace

ShapeScale scale_of(const Box& box, const std::optional<double>& metres_per_unit) {
  ShapeScale scale{box.diagonal(), 0, box.middle(), metres_per_unit, {}};
  for (std::size_t k = 0; k < 3; ++k) scale.longest = std::max(scale.longest, box.high[k] - box.low[k]);
  return scale;
}

ShapeScale scale_of(const TriangleMesh& shape) { return scale_of(box_of(shape.points), shape.metres_per_unit); }

ShapeScale scale_of(const NodeShape& nodes, const TriangleMesh& mesh) {
  const Grid* grid = std::get_if<Grid>(&nodes);
  const Cells* cells = std::get_if<Cells>(&nodes);
  const bool on_polygons = cells && !cells->on->triangles.empty();
  ShapeScale scale = scale_of(grid ? box_of_cells(*grid) : box_of(on_polygons ? cells->on->points : mesh.points),
                              mesh.metres_per_unit);
  scale.cell = std::visit(NodeDistance{mesh}, nodes);
  return scale;
}

ShapeScale scale_of(const ShapeFile& shape) {
  return shape.nodes ? scale_of(*shape.nodes, shape.mesh) : scale_of(shape.mesh);
}

double world_length(const Given<Length>& length, const ShapeScale& scale) {
  const Length& l = length.value;
  switch (l.unit) {
    case Length::Unit::diagonals:
      return l.value * scale.diagonal;
    case Length::Unit::metres:
      if (!scale.metres_per_unit) refuse_unknown_unit(length, scale);
      return l.value / *scale.metres_per_unit;
    case Length::Unit::cells:
      if (!scale.cell) throw Error(Fault::usage, "px are cells of a grid, and the shape is none", length.where);
      return l.value * *scale.cell;
    case Length::Unit::world:
      break;
  }
  return l.value;
}

void require_fraction(const char* what, const std::optional<Given<Length>>& length) {
  if (!length || length->value.unit != Length::Unit::diagonals || length->value.value <= 1) return;
  const std::string given = number(length->value.value);
  throw Error(Fault::usage,
              std::string(what) + " " + given + " is " + given +
                  " diagonals of the shape; give a fraction of at most 1, or write " + given + "u for " + given +
                  " units of the file (" + given + "mm for millimetres)",
              length->where);
}

void require_sizes(const Stage& stage) {
  if (stage.size && stage.unit)
    throw Error(Fault::usage, "a stage has either a size or a unit, since one follows from the other",
                stage.unit->where);
  require_fraction("size", stage.size);
  require_fraction("unit", stage.unit);
  require_fraction("points", stage.points);
}

StageSize stage_size(const Stage& stage, double model_wavelength, const ShapeScale& scale) {
  if (stage.unit) {
    const double unit = world_length(*stage.unit, scale);
    return {unit * model_wavelength, unit};
  }
  const double size = world_length(stage.size.value_or(Given<Length>{{default_size}, {}}), scale);
  return {size, size / model_wavelength};
}

}  // namespace pelage
