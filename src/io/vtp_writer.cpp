#include "io/vtp_writer.h"

#include <cstdint>

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

void append_polygons(std::string& text, const PolygonMesh& mesh) {
  std::string corners, ends;
  for (std::int32_t v : mesh.corners) append_bytes(corners, v);
  for (std::size_t end : mesh.face_ends) append_bytes(ends, static_cast<std::int32_t>(end));
  text += "<Polys>\n";
  append_vtk_array(text, "Int32", "connectivity", 1, corners);
  append_vtk_array(text, "Int32", "offsets", 1, ends);
  text += "</Polys>\n";
}

}  // namespace

std::string encode_vtp(const PolygonMesh& original) {
  const PolygonMesh mesh = split_corners(original);
  std::string text = vtk_head("PolyData") + ">\n";
  const std::string labels = vtk_labels(mesh.attributes);
  if (!labels.empty()) text += "<FieldData>\n" + labels + "</FieldData>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
          std::to_string(mesh.face_count()) + "\">\n";
  text += vtk_point_data_tag(mesh.attributes);
  append_attributes(text, mesh, Domain::vertex);
  text += "</PointData>\n<CellData>\n";
  append_attributes(text, mesh, Domain::face);
  text += "</CellData>\n";
  append_points(text, mesh);
  append_polygons(text, mesh);
  return text + "</Piece>\n" + vtk_tail("PolyData");
}

}  // namespace pelage
