#include "io/vtp_writer.h"

#include <algorithm>
#include <cstdint>

#include "base/srgb.h"
#include "io/bytes.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

std::string pack_floats(const std::vector<double>& values) {
  std::string bytes;
  bytes.reserve(sizeof(float) * values.size());
  for (double value : values) append_bytes(bytes, static_cast<float>(value));
  return bytes;
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

std::string pack_rgb(const Attribute& color) {
  std::string bytes;
  for (std::size_t i = 0; i < color.values.size(); i += color.components)
    for (std::size_t k = 0; k < 3; ++k) append_bytes(bytes, srgb_byte(color.values[i + k]));
  return bytes;
}

void append_attribute(std::string& text, const Attribute& attribute) {
  if (attribute.name == "color" && attribute.components >= 3)
    append_array(text, "UInt8", "RGB", 3, pack_rgb(attribute));
  else if (attribute.name == "normal" && attribute.components == 3)
    append_array(text, "Float32", "Normals", 3, pack_floats(attribute.values));
  else if (attribute.name == "uv" && attribute.components == 2)
    append_array(text, "Float32", "TextureCoordinates", 2, pack_floats(attribute.values));
  else
    append_array(text, "Float32", attribute.name, attribute.components, pack_floats(attribute.values));
}

void append_points(std::string& text, const TriangleMesh& mesh) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.points.size());
  for (const Point& p : mesh.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  text += "<Points>\n";
  append_array(text, "Float32", "Points", 3, pack_floats(coordinates));
  text += "</Points>\n";
}

void append_triangles(std::string& text, const std::vector<Triangle>& triangles) {
  std::string corners, ends;
  for (const Triangle& t : triangles) {
    for (std::int32_t v : t) append_bytes(corners, v);
    append_bytes(ends, static_cast<std::int32_t>(corners.size() / sizeof(std::int32_t)));
  }
  text += "<Polys>\n";
  append_array(text, "Int32", "connectivity", 1, corners);
  append_array(text, "Int32", "offsets", 1, ends);
  text += "</Polys>\n";
}

/// Says which arrays are the active ones; three.js needs at least one attribute here.
std::string point_data_tag(const TriangleMesh& mesh) {
  std::string tag = "<PointData";
  if (mesh.find("color")) {
    tag += " Scalars=\"RGB\"";
  } else {
    const auto scalar = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                     [](const Attribute& attribute) { return attribute.components == 1; });
    if (scalar != mesh.attributes.end()) tag += " Scalars=\"" + escape_xml(scalar->name) + "\"";
  }
  if (mesh.find("normal")) tag += " Normals=\"Normals\"";
  if (mesh.find("uv")) tag += " TCoords=\"TextureCoordinates\"";
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

std::string encode_vtp(const TriangleMesh& original) {
  const TriangleMesh mesh = split_corners(original);
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
          std::to_string(mesh.triangles.size()) + "\">\n";
  text += point_data_tag(mesh);
  for (const Attribute& attribute : mesh.attributes) append_attribute(text, attribute);
  text += "</PointData>\n";
  append_points(text, mesh);
  append_triangles(text, mesh.triangles);
  return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace pelage
