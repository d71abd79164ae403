// pelage fair: takes the noise off a mesh.

#include "pelage/fair.h"

#include <cstdio>
#include <memory>

#include "base/suggest.h"
#include "command.h"
#include "fair/attribute.h"
#include "input_unit.h"
#include "interrupt.h"
#include "outputs.h"
#include "progress_bar.h"
#include "text.h"

namespace pelage {

namespace {

struct FairCommand {
  std::string shape;
  std::vector<std::string> outputs;
  FairOptions options;
  std::string attribute;  ///< to be smoothed instead of the mesh, or empty
  std::optional<std::string> method;
  std::optional<double> input_unit;  ///< metres
  bool json = false, quiet = false;
};

std::string edges(double length) { return brief(length) + " mean edges"; }

std::string settings(const FairReport& r) {
  std::string text;
  if (r.tau > 0) text += ", tau " + brief(r.tau) + " edge^2";
  if (r.sigma > 0) text += ", sigma " + brief(r.sigma) + " edge";
  if (r.angle > 0) text += ", angle " + brief(r.angle) + " degrees";
  if (r.range > 0) text += ", range of normals " + brief(r.range);
  return text;
}

void print_report(const FairCommand& command, const FairReport& r) {
  const bool given = command.options.noise.has_value();
  std::printf("noise     %s (%s)\n", edges(r.noise).c_str(), given ? "as given" : "estimated");
  std::printf("faired    %d steps of %s%s\n", r.steps, command.method.value_or(command.options.method).c_str(),
              settings(r).c_str());
  std::printf("moved     %s along the normals\n", edges(r.moved).c_str());
  if (r.kept > 0) std::printf("kept      %zu vertices, which had no noise\n", r.kept);
  if (r.volume_before != 0)
    std::printf("volume    %s before, %s after\n", number(r.volume_before).c_str(), number(r.volume_after).c_str());
  if (r.folded > 0) std::printf("warning   %zu vertices belong to triangles that are folded over\n", r.folded);
}

Json to_json(const FairCommand& command, const FairReport& r) {
  const auto used = [](double value) { return value > 0 ? json_number(value) : Json(nullptr); };
  return {{"shape", command.shape},
          {"method", command.method.value_or(command.options.method)},
          {"noise_edges", json_number(r.noise)},
          {"mean_edge", json_number(r.mean_edge)},
          {"steps", r.steps},
          {"moved_edges", json_number(r.moved)},
          {"tau", used(r.tau)},
          {"sigma", used(r.sigma)},
          {"angle_degrees", used(r.angle)},
          {"range", used(r.range)},
          {"volume_before", json_number(r.volume_before)},
          {"volume_after", json_number(r.volume_after)},
          {"kept_vertices", r.kept},
          {"folded_vertices", r.folded},
          {"files", command.outputs}};
}

void print_report(const FairCommand& command, const AttributeReport& r) {
  std::printf("noise     %s of %s (%s)\n", brief(r.noise).c_str(), command.attribute.c_str(),
              command.options.noise ? "as given" : "estimated");
  std::printf("smoothed  %d steps", r.steps);
  if (r.contrast > 0) std::printf(", edges from a slope of %s per mean edge", brief(r.contrast).c_str());
  std::printf("\nchanged   %s\n", brief(r.changed).c_str());
}

Json to_json(const FairCommand& command, const AttributeReport& r) {
  return {{"shape", command.shape},
          {"attribute", command.attribute},
          {"noise", json_number(r.noise)},
          {"steps", r.steps},
          {"changed", json_number(r.changed)},
          {"contrast", r.contrast > 0 ? json_number(r.contrast) : Json(nullptr)},
          {"files", command.outputs}};
}

SmoothedAttribute smooth(const FairCommand& command, const TriangleMesh& mesh, const Progress& progress) {
  AttributeOptions options{.noise = command.options.noise, .steps = command.options.steps};
  if (command.method) options.method = *command.method;
  if (command.options.tau) options.tau = *command.options.tau;
  return smooth_attribute(mesh, command.attribute, options, progress);
}

Faired faired(const FairCommand& command, const TriangleMesh& mesh, const Progress& progress) {
  FairOptions options = command.options;
  if (command.method) options.method = *command.method;
  return fair(mesh, options, progress);
}

/// The file's own mesh with its points where they are now, and with the attribute that was smoothed.
PolygonMesh in_form_of_file(const FairCommand& command, const ShapeFile& file, TriangleMesh mesh) {
  if (!file.source) return polygons_of(mesh);
  std::vector<std::string> names;
  for (const Attribute& a : mesh.attributes) names.push_back(a.name);
  const std::string* smoothed = matching_name(command.attribute, names);
  std::erase_if(mesh.attributes, [&](const Attribute& a) { return !smoothed || a.name != *smoothed; });
  return as_in_file(*file.source, mesh);
}

template <class Result>
void finish(const FairCommand& command, const ShapeFile& file, const Result& result, ProgressBar& bar) {
  bar.clear();
  if (!command.quiet && !command.json) print_findings(file.findings);
  const std::vector<std::string> warnings = save_all(in_form_of_file(command, file, result.mesh), command.outputs,
                                                     {object_name(file, command.shape), file.up});
  publish_outputs();
  if (command.json) {
    Json json = to_json(command, result.report);
    json["findings"] = json_findings(file.findings);
    json["warnings"] = warnings;
    return print_json(json);
  }
  if (command.quiet) return;
  print_report(command, result.report);
  print_written(command.outputs);
}

void run_fair(const FairCommand& command) {
  for (const std::string& path : command.outputs) check_mesh_path(path);
  catch_interrupts();
  ProgressBar bar(command.quiet || command.json ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  const ShapeFile file = read_surface(command.shape, command.input_unit);
  if (command.attribute.empty())
    finish(command, file, faired(command, file.mesh, bar.progress()), bar);
  else
    finish(command, file, smooth(command, file.mesh, bar.progress()), bar);
}

void add_method_options(CLI::App* app, FairCommand& command) {
  FairOptions& options = command.options;
  CLI::Option* attribute =
      app->add_option("--attribute", command.attribute,
                      "Smooth this vertex attribute, for example color, and leave the vertices where they are")
          ->type_name("NAME");
  app->add_option("--method", command.method,
                  "guided (default), or for comparison: paper (anisotropic diffusion on the limit surface, Bajaj, "
                  "Zhang, Xu 2008), isotropic, taubin. Of attributes: anisotropic (keeps their edges; "
                  "default), isotropic, paper (keeps apart what edges of the shape part)")
      ->type_name("NAME");
  app->add_option("--noise", options.noise,
                  "Standard deviation of the noise in mean edges, or in the attribute's unit (default: estimated)")
      ->type_name("X");
  app->add_option("--steps", options.steps, "Take so many steps (default: until the noise is off)")->type_name("N");
  app->add_option("--tau", options.tau,
                  "isotropic, paper, attributes: time of one step in squared mean edges (0.1, 0.2, 0.1)")
      ->type_name("X");
  app->add_option("--sigma", options.sigma,
                  "paper: width of a Gaussian before curvatures are taken, edges (default: a bilateral filter)")
      ->type_name("X")
      ->excludes(attribute);
  app->add_option("--angle", options.angle,
                  "paper: bend per edge that counts as an edge of the shape, degrees (default: the median, 5 or more)")
      ->type_name("X")
      ->excludes(attribute);
  app->add_option("--mu", options.mu, "paper: 0 adapts diffusion to the size of triangles, 1 the time step (0)")
      ->type_name("X")
      ->excludes(attribute);
  app->add_option("--motion", options.motion,
                  "paper: normal (default), or full: vertices move in all directions, as printed")
      ->type_name("KIND")
      ->excludes(attribute);
  app->add_flag("--slide", options.slide, "Let boundary vertices move along the boundary (default: they stay)")
      ->excludes(attribute);
}

}  // namespace

Command add_fair(CLI::App& parent) {
  auto command = std::make_shared<FairCommand>();
  CLI::App* app = parent.add_subcommand(
      "fair",
      "Take the noise off a mesh and keep its edges\n"
      "Estimates the noise, filters the normals of the triangles and lets the vertices follow, until shape begins to "
      "go along with the noise. Triangles, attributes and volume stay; boundaries do not move. With --attribute the "
      "same "
      "for a function on the surface. Says what was chosen; options override.");
  app->add_option("SHAPE", command->shape, "An OBJ, PLY, STL, OFF, glTF or GLB file, or builtin:NAME?n=VERTICES")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", command->outputs, "Files to write: .ply, .obj, .glb, .vtp, .stl, .off")
      ->required()
      ->delimiter(',')
      ->type_name("FILES");
  add_method_options(app, *command);
  add_input_unit_option(*app, command->input_unit);
  app->add_flag("--json", command->json, "Print what was done as JSON");
  app->add_flag("-q,--quiet", command->quiet, "Print nothing but errors");
  app->footer(
      "Examples:\n  pelage fair scan.ply -o clean.ply\n  pelage fair scan.ply --attribute color -o even.ply\n  pelage "
      "fair part.stl --noise 0.1 -o clean.stl,clean.glb");
  return {app, [command] { run_fair(*command); }};
}

}  // namespace pelage
