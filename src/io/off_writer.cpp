#include "io/off_writer.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "io/bytes.h"
#include "io/output_set.h"

namespace pelage {

namespace {

void append_color(std::string& text, const Attribute& color, std::size_t i) {
  const double* c = color.values.data() + color.components * i;
  for (int k = 0; k < 3; ++k) text += " " + std::to_string(srgb_byte(c[k]));
  const double alpha = color.components == 4 ? std::clamp(c[3], 0.0, 1.0) : 1;
  text += " " + std::to_string(std::lround(255 * alpha));
}

const Attribute* find_color(const PolygonMesh& mesh, Domain domain) {
  for (const Attribute& a : mesh.attributes)
    if (a.domain == domain && is_color(a) && (a.name == "color" || a.name == "face_color")) return &a;
  return nullptr;
}

}  // namespace

std::string encode_off(const PolygonMesh& mesh) {
  const Attribute* color = find_color(mesh, Domain::vertex);
  const Attribute* face_color = find_color(mesh, Domain::face);
  std::string text = color ? "COFF\n" : "OFF\n";
  text += comment_lines("# pelage ", record_for_files());
  text += std::to_string(mesh.points.size()) + " " + std::to_string(mesh.face_count()) + " 0\n";
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0) text += ' ';
      append_text(text, mesh.points[v][k]);
    }
    if (color) append_color(text, *color, v);
    text += '\n';
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    append_text(text, mesh.face_size(f));
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_ends[f]; ++c) {
      text += ' ';
      append_text(text, mesh.corners[c]);
    }
    if (face_color) append_color(text, *face_color, f);
    text += '\n';
  }
  return text;
}

}  // namespace pelage
