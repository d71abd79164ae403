#include "io/stl_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/srgb.h"
#include "io/bytes.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

Point facet_normal(const TriangleMesh& mesh, const Triangle& t) {
  const Point& a = mesh.points[t[0]];
  const Point n = cross(difference(mesh.points[t[1]], a), difference(mesh.points[t[2]], a));
  const double length = std::hypot(n[0], n[1], n[2]);
  return length > 0 ? Point{n[0] / length, n[1] / length, n[2] / length} : Point{};
}

void append_point(std::string& bytes, const Point& p) {
  for (double x : p) append_bytes(bytes, static_cast<float>(x));
}

/// Bit 15 says that there is a colour: five bits each of red, green and blue, from the highest.
std::uint16_t color_bits(const double* linear) {
  unsigned bits = 1;
  for (int k = 0; k < 3; ++k) bits = bits << 5 | static_cast<unsigned>(std::lround(31 * srgb_from_linear(linear[k])));
  return static_cast<std::uint16_t>(bits);
}

std::string binary(const TriangleMesh& mesh, const Attribute* color) {
  std::string bytes = "binary STL written by pelage";  // must not begin with "solid", the mark of the text form
  constexpr std::size_t header = 80, count = 4, facet = 50;
  bytes.resize(header, ' ');
  bytes.reserve(header + count + facet * mesh.triangles.size());
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    append_point(bytes, facet_normal(mesh, mesh.triangles[f]));
    for (std::int32_t v : mesh.triangles[f]) append_point(bytes, mesh.points[v]);
    append_bytes(bytes, color ? color_bits(color->values.data() + color->components * f) : std::uint16_t{0});
  }
  return bytes;
}

void append_words(std::string& text, const char* keyword, const Point& p) {
  text += keyword;
  for (double x : p) {
    text += ' ';
    append_text(text, static_cast<float>(x));
  }
  text += '\n';
}

/// The facets of one solid after the other, in their order.
std::string solids(const TriangleMesh& mesh, const Attribute& object) {
  std::string text;
  for (std::size_t i = 0; i < object.labels.size(); ++i) {
    std::string facets;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      if (object.values[f] != static_cast<double>(i)) continue;
      append_words(facets, "facet normal", facet_normal(mesh, mesh.triangles[f]));
      facets += "outer loop\n";
      for (std::int32_t v : mesh.triangles[f]) append_words(facets, "vertex", mesh.points[v]);
      facets += "endloop\nendfacet\n";
    }
    if (!facets.empty()) text += "solid " + object.labels[i] + "\n" + facets + "endsolid " + object.labels[i] + "\n";
  }
  return text;
}

}  // namespace

namespace {

/// Whether every face has one of the names: a face without would be in no solid.
bool all_labelled(const Attribute& a) {
  return a.components == 1 && std::all_of(a.values.begin(), a.values.end(), [&](double value) {
           return value >= 0 && value < static_cast<double>(a.labels.size()) && value == std::floor(value);
         });
}

}  // namespace

const Attribute* stl_color(const std::vector<Attribute>& attributes) {
  for (const Attribute& a : attributes)
    if (a.domain == Domain::face && (a.name == "color" || a.name == "face_color") && is_color(a)) return &a;
  return nullptr;
}

const Attribute* stl_object(const std::vector<Attribute>& attributes) {
  for (const Attribute& a : attributes)
    if (a.domain == Domain::face && a.name == "object" && all_labelled(a)) return &a;
  return nullptr;
}

std::string encode_stl(const TriangleMesh& mesh) {
  const Attribute* color = stl_color(mesh.attributes);
  const Attribute* object = stl_object(mesh.attributes);
  return color || !object ? binary(mesh, color) : solids(mesh, *object);
}

}  // namespace pelage
