#include "io/vtp_writer.h"

#include <cstdint>
#include <numeric>

#include "io/bytes.h"
#include "io/ply_writer.h"
#include "io/vtk_xml.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

void append_attributes(std::string& text, const PolygonMesh& mesh, Domain domain) {
  for (const Attribute& a : mesh.attributes)
    if (a.domain == domain) append_vtk_attribute(text, a, ColorBits::eight);
}

void append_points(std::string& text, const PolygonMesh& mesh) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.points.size());
  for (const Point& p : mesh.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  const NumberType type = floats_suffice(mesh.points) ? NumberType::float32 : NumberType::float64;
  text += "<Points>\n";
  append_vtk_array(text, vtk_name(type), "Points", 3, packed(coordinates, type));
  text += "</Points>\n";
}

void append_cells(std::string& text, const char* kind, const std::vector<std::int32_t>& corners,
                  const std::vector<std::size_t>& cell_ends) {
  std::string numbers, ends;
  for (const std::int32_t v : corners) append_bytes(numbers, v);
  for (const std::size_t end : cell_ends) append_bytes(ends, static_cast<std::int32_t>(end));
  text += std::string("<") + kind + ">\n";
  append_vtk_array(text, "Int32", "connectivity", 1, numbers);
  append_vtk_array(text, "Int32", "offsets", 1, ends);
  text += std::string("</") + kind + ">\n";
}

/// VTK's programs show what is in cells only: of a cloud every point is one.
void append_vertices(std::string& text, std::size_t count) {
  std::vector<std::int32_t> points(count);
  std::vector<std::size_t> ends(count);
  std::iota(points.begin(), points.end(), 0);
  std::iota(ends.begin(), ends.end(), 1);
  append_cells(text, "Verts", points, ends);
}

}  // namespace

std::string encode_vtp(const PolygonMesh& original) {
  const PolygonMesh mesh = split_corners(original);
  std::string text = vtk_head("PolyData") + ">\n";
  const std::string data = vtk_labels(mesh.attributes) + vtk_record();
  if (!data.empty()) text += "<FieldData>\n" + data + "</FieldData>\n";
  const std::size_t vertices = mesh.face_ends.empty() ? mesh.points.size() : 0;
  text += "<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) + "\" NumberOfVerts=\"" +
          std::to_string(vertices) + "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
          std::to_string(mesh.face_count()) + "\">\n";
  text += vtk_point_data_tag(mesh.attributes);
  append_attributes(text, mesh, Domain::vertex);
  text += "</PointData>\n<CellData>\n";
  append_attributes(text, mesh, Domain::face);
  text += "</CellData>\n";
  append_points(text, mesh);
  if (vertices > 0) append_vertices(text, vertices);
  append_cells(text, "Polys", mesh.corners, mesh.face_ends);
  return text + "</Piece>\n" + vtk_tail("PolyData");
}

}  // namespace pelage
