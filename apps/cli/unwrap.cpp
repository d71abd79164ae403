// pelage unwrap: texture coordinates for a mesh without any.

#include "pelage/unwrap.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.h"
#include "interrupt.h"
#include "io/png_writer.h"
#include "look/atlas_picture.h"
#include "outputs.h"
#include "progress_bar.h"
#include "soup_input.h"
#include "text.h"
#include "usage.h"

namespace pelage {

namespace {

struct UnwrapCommand {
  std::string shape;
  std::vector<std::string> outputs;
  std::string picture;
  UnwrapOptions options;
  std::optional<double> input_unit;  ///< metres
  bool json = false, quiet = false;

  std::vector<std::string> files() const {
    std::vector<std::string> all = outputs;
    if (!picture.empty()) all.push_back(picture);
    return all;
  }
};

/// The file's own faces; what was repaired is so only in the mesh that is not used here.
PolygonMesh faces_of(ShapeFile& file, const std::string& path) {
  if (file.nodes && std::holds_alternative<TetMesh>(*file.nodes))
    throw Error(Fault::input, "the shape is a volume; an atlas is made of surfaces", {path});
  if (file.nodes)
    throw Error(Fault::input, "the shape is laid out in rows of nodes, which are its texture coordinates already",
                {path});
  if (file.mesh.triangles.empty())
    throw Error(Fault::input, "the shape has no faces: a cloud of points has nothing to unwrap", {path});
  if (!file.source) return polygons_of(file.mesh);
  std::erase_if(file.findings, [](const Finding& f) { return f.repaired; });
  return file.source->polygons;
}

void print_report(const UnwrapReport& r) {
  std::printf("charts    %zu\n", r.charts);
  std::printf("stretch   %s (L2; at worst %s)\n", number(r.stretch, 4).c_str(), number(r.worst_stretch, 4).c_str());
  std::printf("covered   %s %% of the square\n", brief(100 * r.efficiency).c_str());
}

Json to_json(const UnwrapCommand& command, const UnwrapReport& r) {
  return {{"shape", command.shape},
          {"charts", r.charts},
          {"stretch", json_number(r.stretch)},
          {"worst_stretch", json_number(r.worst_stretch)},
          {"efficiency", json_number(r.efficiency)},
          {"scale", json_number(r.scale)},
          {"files", command.files()}};
}

void check_outputs(const UnwrapCommand& command) {
  for (const std::string& path : command.outputs) check_mesh_path(path);
  if (command.picture.empty()) return;
  check_picture_path(command.picture);
}

constexpr int picture_width = 1200;

void run_unwrap(const UnwrapCommand& command) {
  check_outputs(command);
  catch_interrupts();
  ProgressBar bar(command.quiet || command.json ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  ShapeFile file = read_soup(command.shape, command.input_unit, "charts take");
  PolygonMesh mesh = faces_of(file, command.shape);
  Unwrapped result = unwrap(mesh, command.options, bar.progress());
  bar.clear();
  std::ranges::move(result.findings, std::back_inserter(file.findings));
  mesh.set(std::move(result.uv));
  if (!command.quiet && !command.json) print_findings(file.findings);
  const std::vector<std::string> warnings =
      save_all(mesh, command.outputs, {object_name(file, command.shape), file.up});
  if (!command.picture.empty()) write_png(atlas_picture(mesh, result.chart, picture_width), command.picture);
  publish_outputs();
  if (command.json) {
    Json json = to_json(command, result.report);
    json["findings"] = json_findings(file.findings);
    json["warnings"] = warnings;
    return print_json(json);
  }
  if (command.quiet) return;
  print_report(result.report);
  print_written(command.files());
}

}  // namespace

Command add_unwrap(CLI::App& parent) {
  auto command = std::make_shared<UnwrapCommand>();
  CLI::App* app = parent.add_subcommand(
      "unwrap",
      "Give a mesh texture coordinates\n"
      "Cuts the surface along its edges into charts, lays them flat with little distortion and puts them side by side "
      "into the unit square. No triangle is turned over, no two overlap. Vertices, faces and attributes stay as they "
      "are in the file.");
  app->add_option("SHAPE", command->shape, "An OBJ, PLY, STL, OFF, glTF or GLB file, or builtin:NAME?n=VERTICES")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", command->outputs, "Files to write: .obj, .glb, .ply, .vtp")
      ->required()
      ->delimiter(',')
      ->type_name("FILES");
  app->add_option("--picture", command->picture, "Draw the charts into a PNG file")->type_name("FILE");
  app->add_option("--resolution", command->options.resolution,
                  "Width of the texture for which the margin counts (2048)")
      ->check(whole_number(16, 65536))
      ->type_name("TEXELS");
  app->add_option("--margin", command->options.margin, "Between charts, in texels (4)")
      ->check(number_at_least_zero())
      ->type_name("TEXELS");
  add_input_unit_option(*app, command->input_unit);
  app->add_flag("--json", command->json, "Print what was done as JSON");
  app->add_flag("-q,--quiet", command->quiet, "Print nothing but errors");
  app->footer(
      "Examples:\n  pelage unwrap cow.obj -o cow_uv.obj\n  pelage unwrap scan.ply -o scan_uv.glb --resolution 4096 "
      "--margin 8");
  return {app, [command] { run_unwrap(*command); }};
}

}  // namespace pelage
