#include "measured_coat.h"

#include <memory>
#include <numbers>

#include "base/suggest.h"
#include "discretise/cell_space.h"
#include "measure/node_pattern.h"
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

std::vector<const Attribute*> fields_of(const TriangleMesh& mesh) {
  std::vector<const Attribute*> fields;
  for (const Attribute& a : mesh.attributes)
    if (a.domain == Domain::vertex && a.components == 1) fields.push_back(&a);
  return fields;
}

const Attribute& field_of(const TriangleMesh& mesh, const std::string& name, const std::string& path) {
  const std::vector<const Attribute*> fields = fields_of(mesh);
  if (fields.empty())
    throw Error(Fault::input,
                "there is no number at the vertices to measure; a coat in .vtp, .ply, .vtu or .vti has its species",
                {path});
  if (name.empty()) return *fields.front();
  std::vector<std::string> names;
  for (const Attribute* field : fields) {
    if (field->name == name) return *field;
    names.push_back(field->name);
  }
  throw Error(Fault::usage, "--field: " + unknown_name("field", name, names));
}

double wavelength_of(double wave_number) { return 2 * std::numbers::pi / wave_number; }

}  // namespace pelage
