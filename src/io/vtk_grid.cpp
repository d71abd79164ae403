#include "io/vtk_grid.h"

#include <algorithm>

#include "base/number.h"
#include "io/vtk_xml.h"
#include "io/write_mesh.h"
#include "pelage/error.h"
#include "shape/grid.h"

namespace pelage {

namespace {

std::string extent_of(const Grid& grid) {
  std::string text;
  for (const std::int32_t n : grid.count) text += (text.empty() ? "0 " : " 0 ") + std::to_string(n - 1);
  return text;
}

std::string triple(const Point& p) { return exact_number(p[0]) + " " + exact_number(p[1]) + " " + exact_number(p[2]); }

std::vector<Point> points_of(const Grid& grid) {
  std::vector<Point> points(grid.nodes());
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = grid.point(static_cast<std::int32_t>(v));
  return points;
}

std::vector<double> periods(const Grid& grid) {
  std::vector<double> values;
  for (std::size_t d = 0; d < 3; ++d) {
    Point period = grid.period[d];
    if (grid.even() && grid.periodic[d]) period[d] = grid.spacing[d] * grid.count[d];
    values.insert(values.end(), period.begin(), period.end());
  }
  return values;
}

void append_field_data(std::string& text, const Grid& grid, bool with_points) {
  std::string data = vtk_labels(grid.attributes);
  if (std::ranges::count(grid.periodic, true) > 0) {
    append_vtk_array(data, "Int8", "periodic", 3,
                     packed({grid.periodic.begin(), grid.periodic.end()}, NumberType::int8), 1);
    if (with_points) append_vtk_array(data, "Float64", "period", 3, packed(periods(grid), NumberType::float64), 3);
  }
  data += vtk_unit(grid.metres_per_unit) + vtk_record();
  if (!data.empty()) text += "<FieldData>\n" + data + "</FieldData>\n";
}

void append_piece(std::string& text, const Grid& grid, bool with_points) {
  text += "<Piece Extent=\"" + extent_of(grid) + "\">\n" + vtk_point_data_tag(grid.attributes);
  for (const Attribute& a : grid.attributes) append_vtk_attribute(text, a, ColorBits::as_stored);
  text += "</PointData>\n";
  if (with_points) append_vtk_points(text, points_of(grid));
  text += "</Piece>\n";
}

std::string encode(const Grid& grid, const std::string& kind, const std::string& place) {
  require_sound(grid);
  require_finite(grid.points, grid.attributes);
  const bool with_points = place.empty();
  std::string text = vtk_head(kind) + " WholeExtent=\"" + extent_of(grid) + "\"" + place + ">\n";
  append_field_data(text, grid, with_points);
  append_piece(text, grid, with_points);
  return text + vtk_tail(kind);
}

}  // namespace

std::string vti_bytes(const Grid& grid) {
  if (!grid.even()) throw Error(Fault::usage, "VTI holds even grids only; write this one as .vts");
  return encode(grid, "ImageData", " Origin=\"" + triple(grid.origin) + "\" Spacing=\"" + triple(grid.spacing) + "\"");
}

std::string vts_bytes(const Grid& grid) { return encode(grid, "StructuredGrid", ""); }

}  // namespace pelage
