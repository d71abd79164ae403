#include "look/kept_shape.h"

#include <utility>

#include "look/dress.h"

namespace pelage {

SourceShape own_form(const TriangleMesh& mesh) {
  PolygonMesh polygons = polygons_of(mesh);
  std::vector<std::int32_t> vertex(polygons.corners.begin(), polygons.corners.end());
  return {std::move(polygons), std::move(vertex)};
}

PolygonMesh kept_shape(SourceShape source, const TriangleMesh& coat, const Paint& paint) {
  rename_input(source.polygons.attributes, paint);
  TriangleMesh added = coat;
  std::erase_if(added.attributes, [&](const Attribute& a) { return source.polygons.find(a.name) != nullptr; });
  return as_in_file(source, added);
}

}  // namespace pelage
