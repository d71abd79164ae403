#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ascii.h"
#include "pelage/grid.h"
#include "pelage/polygon_mesh.h"
#include "pelage/tet_mesh.h"

namespace pelage {

namespace {

const Attribute* find_in(const std::vector<Attribute>& attributes, std::string_view name) {
  const auto it =
      std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; });
  return it == attributes.end() ? nullptr : &*it;
}

void set_in(std::vector<Attribute>& attributes, Attribute attribute) {
  if (const Attribute* old = find_in(attributes, attribute.name))
    attributes[old - attributes.data()] = std::move(attribute);
  else
    attributes.push_back(std::move(attribute));
}

}  // namespace

const char* name_of(NumberType type) {
  static constexpr const char* names[] = {"float32", "float64", "int8", "uint8", "int16", "uint16", "int32", "uint32"};
  return names[static_cast<int>(type)];
}

bool is_color(const Attribute& a) {
  static constexpr std::string_view names[] = {"face_color", "corner_color", "material_color"}, input = "input_",
                                    set = "color";
  std::string_view name = a.name;
  while (name.starts_with(input)) name.remove_prefix(input.size());
  const bool numbered = name.starts_with(set) && std::all_of(name.begin() + set.size(), name.end(), is_digit);
  return (numbered || std::ranges::count(names, name) > 0) && (a.components == 3 || a.components == 4);
}

void widen(Attribute& a) {
  const auto is_whole = [](double x) { return x == std::floor(x); };
  if (is_integer(a.type) && !is_color(a) && !std::ranges::all_of(a.values, is_whole)) a.type = NumberType::float64;
}

const Attribute* TriangleMesh::find(std::string_view name) const { return find_in(attributes, name); }
Attribute* TriangleMesh::find(std::string_view name) { return const_cast<Attribute*>(find_in(attributes, name)); }
void TriangleMesh::set(Attribute attribute) { set_in(attributes, std::move(attribute)); }

const Attribute* PolygonMesh::find(std::string_view name) const { return find_in(attributes, name); }
Attribute* PolygonMesh::find(std::string_view name) { return const_cast<Attribute*>(find_in(attributes, name)); }
void PolygonMesh::set(Attribute attribute) { set_in(attributes, std::move(attribute)); }

const Attribute* Grid::find(std::string_view name) const { return find_in(attributes, name); }
void Grid::set(Attribute attribute) { set_in(attributes, std::move(attribute)); }

const Attribute* TetMesh::find(std::string_view name) const { return find_in(attributes, name); }
void TetMesh::set(Attribute attribute) { set_in(attributes, std::move(attribute)); }

PolygonMesh polygons_of(const TriangleMesh& mesh) {
  PolygonMesh result;
  result.points = mesh.points;
  result.attributes = mesh.attributes;
  result.links = mesh.links;
  result.metres_per_unit = mesh.metres_per_unit;
  result.corners.reserve(3 * mesh.triangles.size());
  result.face_ends.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    result.corners.insert(result.corners.end(), t.begin(), t.end());
    result.end_face();
  }
  return result;
}

}  // namespace pelage
