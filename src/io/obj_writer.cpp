#include "io/obj_writer.h"

#include <cmath>

#include "base/srgb.h"
#include "io/bytes.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

/// Values of one attribute as an OBJ file holds them: a list, and per corner a place in it.
struct IndexedValues {
  Attribute list;
  std::vector<Triangle> index;  // empty: the mesh does not have the attribute
};

IndexedValues index_values(const TriangleMesh& mesh, const char* name) {
  const Attribute* attribute = mesh.find(name);
  if (!attribute) return {};
  if (attribute->domain == Domain::vertex) return {*attribute, mesh.triangles};
  CornerSplit split = find_split(mesh, {attribute});
  return {split_attribute(*attribute, split), std::move(split.triangles)};
}

void append_list(std::string& text, const char* keyword, const IndexedValues& values) {
  const std::size_t components = values.list.components;
  for (std::size_t i = 0; i < values.list.values.size(); i += components) {
    text += keyword;
    for (std::size_t k = 0; k < components; ++k) {
      text += ' ';
      append_text(text, static_cast<float>(values.list.values[i + k]));
    }
    text += '\n';
  }
}

/// Four decimals: finer than the 8 bits that readers keep, and half the size of all digits.
double rounded_srgb(double linear) { return std::round(1e4 * srgb_from_linear(linear)) / 1e4; }

void append_vertices(std::string& text, const TriangleMesh& mesh, const Attribute* color) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    text += 'v';
    for (double x : mesh.points[v]) {
      text += ' ';
      append_text(text, x);
    }
    for (std::size_t k = 0; color && k < 3; ++k) {
      text += ' ';
      append_text(text, rounded_srgb(color->values[color->components * v + k]));
    }
    text += '\n';
  }
}

void append_face(std::string& text, const TriangleMesh& mesh, std::size_t f, const IndexedValues& uv,
                 const IndexedValues& normal) {
  text += 'f';
  for (std::size_t k = 0; k < 3; ++k) {
    text += ' ';
    append_text(text, mesh.triangles[f][k] + 1);
    if (!uv.index.empty() || !normal.index.empty()) text += '/';
    if (!uv.index.empty()) append_text(text, uv.index[f][k] + 1);
    if (!normal.index.empty()) {
      text += '/';
      append_text(text, normal.index[f][k] + 1);
    }
  }
  text += '\n';
}

}  // namespace

std::string encode_obj(const TriangleMesh& mesh) {
  // A colour belongs to v, so that a colour per corner has no place in this format.
  const Attribute* color = mesh.find("color");
  if (color && color->domain == Domain::corner) color = nullptr;
  const IndexedValues uv = index_values(mesh, "uv");
  const IndexedValues normal = index_values(mesh, "normal");
  std::string text = "# written by pelage\n";
  append_vertices(text, mesh, color);
  append_list(text, "vt", uv);
  append_list(text, "vn", normal);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) append_face(text, mesh, f, uv, normal);
  return text;
}

}  // namespace pelage
