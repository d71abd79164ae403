#include "io/off_writer.h"

#include "io/bytes.h"

namespace pelage {

std::string encode_off(const TriangleMesh& mesh) {
  std::string text =
      "OFF\n" + std::to_string(mesh.points.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Point& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      append_text(text, p[k]);
      text += k < 2 ? ' ' : '\n';
    }
  }
  for (const Triangle& t : mesh.triangles) {
    text += '3';
    for (std::int32_t v : t) {
      text += ' ';
      append_text(text, v);
    }
    text += '\n';
  }
  return text;
}

}  // namespace pelage
