#include "input_unit.h"

#include "base/length_unit.h"
#include "base/suggest.h"
#include "catalog/shapes.h"

namespace pelage {

CLI::Option* add_input_unit_option(CLI::App& app, std::optional<double>& metres) {
  return app
      .add_option_function<std::string>(
          "--input-unit",
          [&metres](const std::string& name) {
            metres = metres_in(name);
            if (!metres) throw CLI::ValidationError("--input-unit", unknown_name("unit", name, length_unit_names()));
          },
          "Length of a unit of the shape's file: " + join_names(length_unit_names()) +
              " (default: mm for STL, m for glTF; OBJ, PLY and OFF do not say)")
      ->type_name("UNIT");
}

ShapeFile read_shape(const std::string& path, const std::optional<double>& metres_per_unit) {
  ShapeFile file = find_shape(path);
  if (!metres_per_unit) return file;
  file.mesh.metres_per_unit = metres_per_unit;
  if (file.nodes) {
    NodeShape nodes = *file.nodes;
    std::visit(
        [&](auto& shape) {
          if constexpr (requires { shape.metres_per_unit; }) shape.metres_per_unit = metres_per_unit;
        },
        nodes);
    file.nodes = std::make_shared<const NodeShape>(std::move(nodes));
  }
  std::erase_if(file.findings, [](const Finding& f) { return f.kind == "unit"; });
  return file;
}

ShapeFile read_surface(const std::string& path, const std::optional<double>& metres_per_unit) {
  ShapeFile file = read_shape(path, metres_per_unit);
  if (file.mesh.triangles.empty() && !file.nodes)
    throw Error(Fault::input, "the shape has no faces: of a cloud of points, grow and cells make something", {path});
  return file;
}

}  // namespace pelage
