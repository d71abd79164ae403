#include "shape/numbered_mesh.h"

#include <algorithm>

namespace pelage {

namespace {

/// values[i] = old values[source[i]] for tuples of `width` values; source may only ascend or values be copied.
void gather_tuples(std::vector<double>& values, std::size_t width, const std::vector<std::int32_t>& source) {
  std::vector<double> gathered(width * source.size());
  for (std::size_t i = 0; i < source.size(); ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(width * source[i]), width,
                gathered.begin() + static_cast<std::ptrdiff_t>(width * i));
  values = std::move(gathered);
}

template <class T>
void gather(std::vector<T>& items, const std::vector<std::int32_t>& source) {
  std::vector<T> gathered(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) gathered[i] = items[source[i]];
  items = std::move(gathered);
}

}  // namespace

void keep_faces(NumberedMesh& work, const std::vector<char>& keep) {
  std::vector<std::int32_t> source;
  for (std::size_t f = 0; f < keep.size(); ++f)
    if (keep[f]) source.push_back(static_cast<std::int32_t>(f));
  if (source.size() == keep.size()) return;
  gather(work.mesh.triangles, source);
  gather(work.face_number, source);
  for (Attribute& a : work.mesh.attributes)
    if (a.domain != Domain::vertex)
      gather_tuples(a.values, static_cast<std::size_t>(a.domain == Domain::corner ? 3 : 1) * a.components, source);
}

void gather_vertices(NumberedMesh& work, const std::vector<std::int32_t>& source) {
  gather(work.mesh.points, source);
  gather(work.vertex_number, source);
  for (Attribute& a : work.mesh.attributes)
    if (a.domain == Domain::vertex) gather_tuples(a.values, a.components, source);
}

void flip_faces(TriangleMesh& mesh, const std::vector<char>& flip) {
  for (std::size_t f = 0; f < flip.size(); ++f) {
    if (!flip[f]) continue;
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    for (Attribute& a : mesh.attributes) {
      if (a.domain != Domain::corner) continue;
      const auto corner = a.values.begin() + static_cast<std::ptrdiff_t>((3 * f + 1) * a.components);
      std::swap_ranges(corner, corner + a.components, corner + a.components);
    }
  }
}

Dropped drop_unused_vertices(NumberedMesh& work) {
  std::vector<std::int32_t> number(work.mesh.points.size(), -1), source;
  for (const Triangle& t : work.mesh.triangles)
    for (std::int32_t v : t) number[v] = 0;
  Dropped dropped;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == 0) {
      number[v] = static_cast<std::int32_t>(source.size());
      source.push_back(static_cast<std::int32_t>(v));
    } else if (dropped.count++ == 0) {
      dropped.first = work.vertex_number[v];
    }
  }
  if (dropped.count == 0) return dropped;
  gather_vertices(work, source);
  for (Triangle& t : work.mesh.triangles)
    for (std::int32_t& v : t) v = number[v];
  return dropped;
}

}  // namespace pelage
