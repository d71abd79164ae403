#include "shape/cell_outlines.h"

#include <algorithm>

#include "shape/cell_shapes.h"

namespace pelage {

PolygonMesh outlines_of(const Cells& cells) {
  PolygonMesh mesh;
  mesh.points = cells.points;
  mesh.metres_per_unit = cells.on->metres_per_unit;
  Attribute sides{"sides", 1, Domain::face, {}}, area{"area", 1, Domain::face, {}};
  const CellShapes shapes(cells);
  CellShapes::Scratch scratch;
  for (std::size_t i = 0; i < cells.nodes(); ++i) {
    const PlaneCell shape = shapes.shape(i, scratch);
    const TangentFrame frame(cells.normals[i]);
    for (const PlanePoint& corner : shape.corner) {
      Point p = frame.out(corner);
      for (std::size_t k = 0; k < 3; ++k) p[k] += cells.points[i][k];
      mesh.corners.push_back(static_cast<std::int32_t>(mesh.points.size()));
      mesh.points.push_back(p);
    }
    mesh.end_face();
    const auto others = std::ranges::count_if(shape.beyond, [](const PlaneCell::Beyond& b) { return b.cell >= 0; });
    sides.values.push_back(static_cast<double>(others));
    area.values.push_back(shape.area());
  }
  mesh.attributes = {std::move(sides), std::move(area)};
  return mesh;
}

}  // namespace pelage
