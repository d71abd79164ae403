#include "io/vtu_writer.h"

#include "io/bytes.h"
#include "io/vtk_xml.h"
#include "io/write_mesh.h"

namespace pelage {

namespace {

constexpr char tetrahedron = 10;  // VTK's number of that kind of cells

void append_cells(std::string& text, const TetMesh& volume) {
  std::string corners, ends;
  for (const Tetrahedron& t : volume.tets)
    for (const std::int32_t v : t) append_bytes(corners, v);
  for (std::size_t i = 1; i <= volume.tets.size(); ++i) append_bytes(ends, static_cast<std::int64_t>(4 * i));
  text += "<Cells>\n";
  append_vtk_array(text, "Int32", "connectivity", 1, corners);
  append_vtk_array(text, "Int64", "offsets", 1, ends);
  append_vtk_array(text, "UInt8", "types", 1, std::string(volume.tets.size(), tetrahedron));
  text += "</Cells>\n";
}

}  // namespace

std::string vtu_bytes(const TetMesh& volume) {
  require_finite(volume.points, volume.attributes);
  std::string text = vtk_head("UnstructuredGrid") + ">\n";
  const std::string data = vtk_labels(volume.attributes) + vtk_unit(volume.metres_per_unit) + vtk_record();
  if (!data.empty()) text += "<FieldData>\n" + data + "</FieldData>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(volume.points.size()) + "\" NumberOfCells=\"" +
          std::to_string(volume.tets.size()) + "\">\n" + vtk_point_data_tag(volume.attributes);
  for (const Attribute& a : volume.attributes) append_vtk_attribute(text, a, ColorBits::as_stored);
  text += "</PointData>\n";
  append_vtk_points(text, volume.points);
  append_cells(text, volume);
  return text + "</Piece>\n" + vtk_tail("UnstructuredGrid");
}

}  // namespace pelage
