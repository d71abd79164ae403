#include "io/stl_writer.h"

#include <cmath>
#include <cstdint>

#include "io/bytes.h"

namespace pelage {

namespace {

Point facet_normal(const Point& a, const Point& b, const Point& c) {
  const Point e = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Point f = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Point n = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  return length > 0 ? Point{n[0] / length, n[1] / length, n[2] / length} : Point{};
}

void append_point(std::string& bytes, const Point& p) {
  for (double x : p) append_bytes(bytes, static_cast<float>(x));
}

}  // namespace

std::string encode_stl(const TriangleMesh& mesh) {
  std::string bytes = "binary STL written by pelage";  // must not begin with "solid", the mark of the text form
  constexpr std::size_t header = 80, count = 4, facet = 50;
  bytes.resize(header, ' ');
  bytes.reserve(header + count + facet * mesh.triangles.size());
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    append_point(bytes, facet_normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    for (std::int32_t v : t) append_point(bytes, mesh.points[v]);
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace pelage
