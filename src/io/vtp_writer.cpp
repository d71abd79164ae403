#include "io/vtp_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/srgb.h"
#include "io/bytes.h"
#include "io/ply_writer.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

std::string pack(const std::vector<double>& values, NumberType type) {
  std::string bytes;
  for (double value : values) append_number(bytes, type, value);
  return bytes;
}

const char* vtk_name(NumberType type) {
  static constexpr const char* names[] = {"Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32"};
  return names[static_cast<int>(type)];
}

std::string escape_xml(const std::string& text) {
  std::string safe;
  for (char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"')
      safe += "&#" + std::to_string(static_cast<int>(c)) + ";";
    else
      safe += static_cast<unsigned char>(c) < ' ' ? '_' : c;
  }
  return safe;
}

void append_array(std::string& text, const std::string& type, const std::string& name, int components,
                  const std::string& bytes) {
  text += "<DataArray type=\"" + type + "\" Name=\"" + escape_xml(name) + "\" NumberOfComponents=\"" +
          std::to_string(components) + "\" format=\"binary\">";  // no white space before the base64: three.js
  std::string block;  // without a compressor the one block is its length in bytes and the values, encoded together
  append_bytes(block, static_cast<std::uint64_t>(bytes.size()));
  append_base64(text, block + bytes);
  text += "</DataArray>\n";
}

std::string pack_color(const Attribute& color) {
  std::string bytes;
  for (std::size_t i = 0; i < color.values.size(); ++i)
    append_bytes(bytes, i % color.components == 3
                            ? static_cast<std::uint8_t>(std::lround(255 * std::clamp(color.values[i], 0.0, 1.0)))
                            : srgb_byte(color.values[i]));
  return bytes;
}

/// The name by which VTK's programs know it.
std::string array_name(const Attribute& a) {
  if (a.name == "color" && is_color(a)) return a.components == 4 ? "RGBA" : "RGB";
  if (a.name == "normal" && a.components == 3) return "Normals";
  if (a.name == "uv" && a.components == 2) return "TextureCoordinates";
  return a.name;
}

void append_attribute(std::string& text, const Attribute& a) {
  if (is_color(a))
    append_array(text, "UInt8", array_name(a), a.components, pack_color(a));
  else
    append_array(text, vtk_name(a.type), array_name(a), a.components, pack(a.values, a.type));
}

void append_attributes(std::string& text, const PolygonMesh& mesh, Domain domain) {
  for (const Attribute& a : mesh.attributes)
    if (a.domain == domain) append_attribute(text, a);
}

void append_points(std::string& text, const PolygonMesh& mesh) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.points.size());
  for (const Point& p : mesh.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  const NumberType type = floats_suffice(mesh.points) ? NumberType::float32 : NumberType::float64;
  text += "<Points>\n";
  append_array(text, vtk_name(type), "Points", 3, pack(coordinates, type));
  text += "</Points>\n";
}

void append_polygons(std::string& text, const PolygonMesh& mesh) {
  std::string corners, ends;
  for (std::int32_t v : mesh.corners) append_bytes(corners, v);
  for (std::size_t end : mesh.face_ends) append_bytes(ends, static_cast<std::int32_t>(end));
  text += "<Polys>\n";
  append_array(text, "Int32", "connectivity", 1, corners);
  append_array(text, "Int32", "offsets", 1, ends);
  text += "</Polys>\n";
}

/// What the numbers of materials, groups and objects mean: arrays of strings, each ended by a 0.
void append_labels(std::string& text, const PolygonMesh& mesh) {
  if (std::ranges::all_of(mesh.attributes, [](const Attribute& a) { return a.labels.empty(); })) return;
  text += "<FieldData>\n";
  for (const Attribute& a : mesh.attributes) {
    if (a.labels.empty()) continue;
    text += "<Array type=\"String\" Name=\"" + escape_xml(a.name) + "_labels\" NumberOfTuples=\"" +
            std::to_string(a.labels.size()) + "\" format=\"ascii\">";
    for (const std::string& label : a.labels) {
      for (unsigned char c : label) text += std::to_string(static_cast<int>(c)) + " ";
      text += "0 ";
    }
    text += "</Array>\n";
  }
  text += "</FieldData>\n";
}

/// Says which arrays are the active ones; three.js needs at least one attribute here.
std::string point_data_tag(const PolygonMesh& mesh) {
  std::string tag = "<PointData";
  const auto first = [&](auto&& fits) {
    const auto found = std::ranges::find_if(mesh.attributes,
                                            [&](const Attribute& a) { return a.domain == Domain::vertex && fits(a); });
    return found == mesh.attributes.end() ? std::string() : escape_xml(array_name(*found));
  };
  const auto named = [&](const char* name) { return first([&](const Attribute& a) { return a.name == name; }); };
  std::string scalars = named("color");
  if (scalars.empty()) scalars = first([](const Attribute& a) { return a.components == 1; });
  if (!scalars.empty()) tag += " Scalars=\"" + scalars + "\"";
  if (!named("normal").empty()) tag += " Normals=\"Normals\"";
  if (!named("uv").empty()) tag += " TCoords=\"TextureCoordinates\"";
  return tag + ">\n";
}

}  // namespace

void append_base64(std::string& text, const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t start = text.size();
  text.resize(start + (bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data() + start;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < count; ++k)
      group |= std::uint32_t{static_cast<unsigned char>(bytes[i + k])} << (16 - 8 * k);
    for (std::size_t k = 0; k <= count; ++k) out[k] = digits[(group >> (18 - 6 * k)) & 63];
    out += 4;
  }
}

std::string encode_vtp(const PolygonMesh& original) {
  const PolygonMesh mesh = split_corners(original);
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";
  append_labels(text, mesh);
  text += "<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
          std::to_string(mesh.face_count()) + "\">\n";
  text += point_data_tag(mesh);
  append_attributes(text, mesh, Domain::vertex);
  text += "</PointData>\n<CellData>\n";
  append_attributes(text, mesh, Domain::face);
  text += "</CellData>\n";
  append_points(text, mesh);
  append_polygons(text, mesh);
  return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace pelage
