// pelage check: what a shape is, and what would be repaired.

#include <cstdio>
#include <memory>

#include "base/length_unit.h"
#include "command.h"
#include "input_unit.h"
#include "node_outputs.h"
#include "pelage/io.h"
#include "shape/describe.h"
#include "shape/tet_cut.h"
#include "text.h"

namespace pelage {

namespace {

void line(const char* label, const std::string& text) { std::printf("  %-14s%s\n", label, text.c_str()); }

std::string place(const Point& p) { return "(" + number(p[0]) + ", " + number(p[1]) + ", " + number(p[2]) + ")"; }

std::string range(const Spread& r) { return number(r.min) + " to " + number(r.max) + ", mean " + number(r.mean); }

std::string boundary(const MeshReport& r) {
  if (r.closed) return "none: the shape is closed";
  return counted(r.boundary_loops, "loop") + ", " + counted(r.boundary_edges, "edge");
}

std::string valences(const MeshReport& r) {
  std::string text;
  for (const auto& [valence, count] : r.valences)
    text += (text.empty() ? "" : ", ") + std::to_string(valence) + " x " + std::to_string(count);
  return text;
}

void print_report(const MeshReport& r, const std::optional<double>& unit) {
  line("vertices", std::to_string(r.vertices));
  line("edges", std::to_string(r.edges));
  line("triangles", std::to_string(r.faces));
  line("components", std::to_string(r.components));
  line("boundary", boundary(r));
  line("genus", std::to_string(r.genus) + " (Euler characteristic " + std::to_string(r.euler_characteristic) + ")");
  std::fputs(("  valences      " + wrapped(valences(r), 16).substr(16)).c_str(), stdout);
  line("edge lengths", range(r.edge_length));
  line("angles", range(r.angle) + " degrees");
  line("area", number(r.area));
  if (r.volume != 0) line("volume", number(r.volume));
  line("bounding box", place(r.low) + " to " + place(r.high) + ", diagonal " + number(r.diagonal));
  line("unit", unit ? unit_name(*unit) : "not in the file");
  for (const std::string& attribute : r.attributes) line("attribute", attribute);
  if (r.findings.empty()) line("findings", "none");
  for (const Finding& f : r.findings) line(f.repaired ? "repaired" : "noted", f.text);
}

Json to_json(const Spread& r) {
  return {{"min", json_number(r.min)}, {"mean", json_number(r.mean)}, {"max", json_number(r.max)}};
}

Json to_json(const MeshReport& r, const std::string& shape, const std::optional<double>& unit) {
  Json valence_counts = Json::object();
  for (const auto& [valence, count] : r.valences) valence_counts[std::to_string(valence)] = count;
  return {{"shape", shape},
          {"vertices", r.vertices},
          {"edges", r.edges},
          {"triangles", r.faces},
          {"components", r.components},
          {"closed", r.closed},
          {"boundary_loops", r.boundary_loops},
          {"boundary_edges", r.boundary_edges},
          {"euler_characteristic", r.euler_characteristic},
          {"genus", r.genus},
          {"valences", valence_counts},
          {"edge_length", to_json(r.edge_length)},
          {"angle_degrees", to_json(r.angle)},
          {"area", json_number(r.area)},
          {"volume", json_number(r.volume)},
          {"low", r.low},
          {"high", r.high},
          {"diagonal", json_number(r.diagonal)},
          {"metres_per_unit", unit ? json_number(*unit) : Json(nullptr)},
          {"attributes", r.attributes},
          {"findings", json_findings(r.findings)}};
}

/// The nodes and cells of a volume; empty for other shapes.
std::string cells_of(const NodeShape* shape) {
  if (!is_volume(shape)) return "";
  if (const auto* tets = std::get_if<TetMesh>(shape))
    return counted(tets->nodes(), "node") + ", " + std::to_string(tets->tets.size()) + " tetrahedra";
  const Grid& block = std::get<Grid>(*shape);
  return counted(block.nodes(), "node") + ", " +
         std::to_string(std::int64_t{block.cells(0)} * block.cells(1) * block.cells(2)) + " cells";
}

/// Of a volume the skin is described.
TriangleMesh described(const ShapeFile& file) {
  if (!is_volume(file.nodes.get())) return file.mesh;
  const auto* tets = as<TetMesh>(file.nodes);
  const CarvedBody skin = tets ? carve(*tets, {}) : carve(*as<Grid>(file.nodes), {});
  TriangleMesh mesh{skin.places(file.mesh.points), skin.triangles, {}, {}, file.mesh.metres_per_unit};
  for (const Attribute& a : file.mesh.attributes) mesh.set(skin.at_vertices(a));
  return mesh;
}

struct CheckOptions {
  std::string shape;
  bool json = false;
};

void check(const CheckOptions& options) {
  ShapeFile file = read_surface(options.shape);
  const std::string cells = cells_of(file.nodes.get());
  MeshReport report = describe(described(file), std::move(file.findings));
  if (file.source && file.source->polygons.find("normal") && !file.mesh.find("normal"))
    report.attributes.emplace_back("normal (of the file, and kept with its form; the surface has its own)");
  if (options.json) {
    Json json = to_json(report, options.shape, file.mesh.metres_per_unit);
    if (!cells.empty()) json["inside"] = cells;
    return print_json(json);
  }
  std::puts(options.shape.c_str());
  if (!cells.empty()) line("inside", cells + "; its skin:");
  print_report(report, file.mesh.metres_per_unit);
}

}  // namespace

Command add_check(CLI::App& parent) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* app = parent.add_subcommand(
      "check",
      "Say what a shape is and what would be repaired\n"
      "Describes a shape as grow sees it: counts, components, genus, boundary, valences, edge lengths, angles, "
      "and what was found and repaired while reading. A shape that cannot be used is refused with exit code 3; "
      "the file itself is never changed.");
  app->add_option("SHAPE", options->shape,
                  "An OBJ, PLY, STL, OFF, glTF or GLB file, or builtin:NAME?n=VERTICES (see grow --help)")
      ->required()
      ->type_name("");
  app->add_flag("--json", options->json, "Print the result as JSON");
  app->footer("Examples:\n  pelage check cow.obj\n  pelage check scan.ply --json");
  return {app, [options] { check(*options); }};
}

}  // namespace pelage
