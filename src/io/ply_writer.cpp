#include "io/ply_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "base/ascii.h"
#include "base/srgb.h"
#include "io/bytes.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

/// What becomes of the values of one attribute, or of one of its components.
enum class Encoding { number, srgb, alpha };

/// One property of the vertices.
struct Column {
  std::string name;
  Encoding encoding;
  const double* values;  // value of vertex v: values[stride * v]
  std::int64_t stride;
};

std::string clean_name(const std::string& name, std::set<std::string>& used) {
  std::string clean = name.empty() ? "value" : name;
  for (char& c : clean)
    if (!is_letter_or_digit(c)) c = '_';
  while (!used.insert(clean).second) clean += '_';
  return clean;
}

std::vector<std::string> property_names(const Attribute& attribute, std::set<std::string>& used) {
  if (attribute.name == "normal" && attribute.components == 3) return {"nx", "ny", "nz"};
  if (attribute.name == "color" && attribute.components == 3) return {"red", "green", "blue"};
  if (attribute.name == "color" && attribute.components == 4) return {"red", "green", "blue", "alpha"};
  if (attribute.name == "uv" && attribute.components == 2) return {"s", "t"};
  if (attribute.components == 1) return {clean_name(attribute.name, used)};
  std::vector<std::string> names;
  for (int k = 0; k < attribute.components; ++k)
    names.push_back(clean_name(attribute.name + "_" + std::to_string(k), used));
  return names;
}

Encoding encoding_of(const std::string& property) {
  if (property == "red" || property == "green" || property == "blue") return Encoding::srgb;
  return property == "alpha" ? Encoding::alpha : Encoding::number;
}

std::vector<Column> list_columns(const TriangleMesh& mesh) {
  // Readers take u and v for texture coordinates, whereas here they are more likely two species.
  std::set<std::string> used = {"x",    "y",     "z", "nx", "ny", "nz", "red",       "green",
                                "blue", "alpha", "s", "t",  "u",  "v",  "texture_u", "texture_v"};
  std::vector<Column> columns;
  for (const Attribute& attribute : mesh.attributes) {
    const std::vector<std::string> names = property_names(attribute, used);
    for (std::size_t k = 0; k < names.size(); ++k)
      columns.push_back({names[k], encoding_of(names[k]), attribute.values.data() + k, attribute.components});
  }
  return columns;
}

/// Rounding moves points of a shape near the origin by less than 1e-7 of its size. Programs draw with floats, and
/// three.js refuses doubles: they are written only where floats would visibly deform the shape, far from the origin.
constexpr double harmless_rounding = 1e-6;

bool floats_suffice(const std::vector<Point>& points) {
  double size = 0, rounding = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point& p : points) {
      low = std::min(low, p[d]);
      high = std::max(high, p[d]);
      rounding = std::max(rounding, std::abs(static_cast<double>(static_cast<float>(p[d])) - p[d]));
    }
    size = std::max(size, high - low);
  }
  return rounding <= harmless_rounding * size;
}

std::string header(const TriangleMesh& mesh, const std::vector<Column>& columns, bool floats) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by pelage\n";
  text += "element vertex " + std::to_string(mesh.points.size()) + "\n";
  for (const char* axis : {"x", "y", "z"})
    text += std::string("property ") + (floats ? "float " : "double ") + axis + "\n";
  for (const Column& column : columns)
    text += (column.encoding == Encoding::number ? "property float " : "property uchar ") + column.name + "\n";
  text += "element face " + std::to_string(mesh.triangles.size()) + "\n";
  return text + "property list uchar int vertex_indices\nend_header\n";
}

void append_value(std::string& bytes, Encoding encoding, double value) {
  if (encoding == Encoding::srgb)
    append_bytes(bytes, srgb_byte(value));
  else if (encoding == Encoding::alpha)
    append_bytes(bytes, static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0))));
  else
    append_bytes(bytes, static_cast<float>(value));
}

void append_vertices(std::string& bytes, const TriangleMesh& mesh, const std::vector<Column>& columns, bool floats) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (double x : mesh.points[v]) {
      if (floats)
        append_bytes(bytes, static_cast<float>(x));
      else
        append_bytes(bytes, x);
    }
    for (const Column& column : columns) append_value(bytes, column.encoding, column.values[column.stride * v]);
  }
}

}  // namespace

std::string encode_ply(const TriangleMesh& original) {
  const TriangleMesh mesh = split_corners(original);
  const std::vector<Column> columns = list_columns(mesh);
  const bool floats = floats_suffice(mesh.points);
  std::string bytes = header(mesh, columns, floats);
  constexpr std::size_t face_size = 13;
  bytes.reserve(bytes.size() + mesh.points.size() * (24 + 4 * columns.size()) + mesh.triangles.size() * face_size);
  append_vertices(bytes, mesh, columns, floats);
  for (const Triangle& t : mesh.triangles) {
    append_bytes(bytes, std::uint8_t{3});
    for (std::int32_t v : t) append_bytes(bytes, v);
  }
  return bytes;
}

}  // namespace pelage
