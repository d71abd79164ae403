#include "catalog/measured_coat.h"

#include <algorithm>
#include <memory>
#include <numbers>

#include "base/suggest.h"
#include "direction/direction_field.h"
#include "discretise/cell_space.h"
#include "measure/node_pattern.h"
#include "measure/pattern.h"
#include "react/formula.h"
#include "shape/cells.h"

namespace pelage {

Ground ground_of(const ShapeFile& file) {
  const Grid* grid = as<Grid>(file.nodes);
  if (as<TetMesh>(file.nodes) || (grid && grid->dimension() == 3)) return Ground::volume;
  return file.mesh.triangles.empty() && !file.nodes ? Ground::cloud : Ground::surface;
}

PatternMeasures measure_coat(const ShapeFile& file, const Attribute& field, const std::optional<double>& level) {
  constexpr int in_space = 3, on_surface = 2;
  switch (ground_of(file)) {
    case Ground::volume: {
      const Method& method = as<TetMesh>(file.nodes) ? tets_method : grid_method;
      return measure_nodes(*method.make_node_space(*file.nodes), in_space, field.values, level);
    }
    case Ground::cloud: {
      const Cells cells = cells_at_points(std::make_shared<const TriangleMesh>(file.mesh));
      std::vector<double> values;
      for (const std::int32_t point : cells.face) values.push_back(field.values[static_cast<std::size_t>(point)]);
      return measure_nodes(CellSpace(cells), on_surface, values, level);
    }
    case Ground::surface:
      break;
  }
  return measure_pattern(file.mesh, field.values, level);
}

namespace {

/// Not of colours, places on images and unit vectors.
bool has_components(const Attribute& a) {
  return a.components > 1 && !is_color(a) && a.name != "uv" && a.name != "normal" && a.name != "tangent" &&
         a.name != direction_attribute;
}

/// What can be measured: an attribute, and which of its components.
struct Field {
  std::string name;
  const Attribute* attribute;
  int component;
};

std::vector<Field> fields_of(const TriangleMesh& mesh) {
  std::vector<Field> fields;
  for (const Attribute& a : mesh.attributes) {
    if (a.domain != Domain::vertex) continue;
    if (a.components == 1) fields.push_back({a.name, &a, 0});
    for (int k = 0; has_components(a) && k < a.components; ++k)
      fields.push_back({component_name(a.name, k + 1), &a, k});
  }
  return fields;
}

}  // namespace

std::vector<std::string> field_names(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : fields_of(mesh)) names.push_back(field.name);
  return names;
}

Attribute field_of(const TriangleMesh& mesh, const std::string& name, const std::string& path) {
  const std::vector<Field> fields = fields_of(mesh);
  if (fields.empty())
    throw Error(Fault::input,
                "there is no number at the vertices to measure; a coat in .vtp, .ply, .vtu or .vti has its species",
                {path});
  const auto named = std::ranges::find(fields, name, &Field::name);
  if (!name.empty() && named == fields.end()) throw Error(Fault::usage, unknown_name("field", name, field_names(mesh)));
  const Field& field = name.empty() ? fields.front() : *named;
  Attribute result{field.name, 1, Domain::vertex, {}};
  for (std::size_t i = static_cast<std::size_t>(field.component); i < field.attribute->values.size();
       i += static_cast<std::size_t>(field.attribute->components))
    result.values.push_back(field.attribute->values[i]);
  return result;
}

PatternMeasures measure(const ShapeFile& shape, const std::string& field, const std::optional<double>& level) {
  return measure_coat(shape, field_of(shape.mesh, field, shape.name), level);
}

double wavelength_of(double wave_number) { return 2 * std::numbers::pi / wave_number; }

}  // namespace pelage
