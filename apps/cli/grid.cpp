// pelage grid: grids fitted to the borders of regions.

#include "shape/grid.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "base/ascii.h"
#include "base/parallel.h"
#include "catalog/regions.h"
#include "command.h"
#include "io/grid_file.h"
#include "io/png_writer.h"
#include "look/grid_lines.h"
#include "outputs.h"
#include "table.h"
#include "text.h"
#include "usage.h"

namespace pelage {

namespace {

struct GridCommand {
  std::string region, picture, nodes;
  std::vector<std::string> outputs;
  int size = 1200;  ///< of the picture
  int threads = 0;
  bool list = false, text = false, json = false, quiet = false;
};

std::string counts(const Region& r) {
  return std::to_string(r.nodes[0]) + " x " + std::to_string(r.nodes[1]) +
         (r.volume ? " x " + std::to_string(r.volume->nodes) : "");
}

void print_regions() {
  std::vector<std::vector<std::string>> rows = {{"NAME", "NODES", "SUMMARY"}};
  for (const std::string& name : region_names()) {
    const Region r = load_region(name);
    rows.push_back({name, counts(r), r.summary});
  }
  std::fputs(table(rows).c_str(), stdout);
}

void print_regions_as_json() {
  Json list = Json::array();
  for (const std::string& name : region_names()) {
    const Region r = load_region(name);
    list.push_back({{"name", name}, {"summary", r.summary}, {"nodes", {r.nodes[0], r.nodes[1]}}});
  }
  print_json(list);
}

/// "200x100".
std::array<std::int32_t, 2> parse_nodes(const std::string& text) {
  constexpr long most = 10000;
  const std::size_t cross = text.find('x');
  std::array<std::int32_t, 2> nodes{};
  for (std::size_t k = 0; k < 2 && cross != std::string::npos; ++k) {
    const std::string part = k == 0 ? text.substr(0, cross) : text.substr(cross + 1);
    const bool digits = !part.empty() && part.size() < 6 && std::ranges::all_of(part, is_digit);
    if (const long n = digits ? std::stol(part) : 0; n >= 2 && n <= most) nodes[k] = static_cast<std::int32_t>(n);
  }
  if (nodes[0] && nodes[1]) return nodes;
  throw Error(Fault::usage, "--nodes " + text + ": expected ALONGxACROSS, each from 2 to 10000, for example 200x100");
}

/// A picture of all of them, in as many nodes as can be told apart.
void draw_regions(const GridCommand& command) {
  constexpr int columns = 4;
  std::vector<NamedGrid> grids;
  for (const std::string& name : region_names()) {
    const Region region = load_region(name);
    GenerateOptions options;
    options.nodes = {region.nodes[0] / 2 + 1, region.nodes[1] / 2 + 1};
    if (!command.nodes.empty()) options.nodes = parse_nodes(command.nodes);
    grids.push_back({name, generate(region, options).grid});
  }
  write_png(grid_lines_sheet(grids, columns, command.size / columns), command.picture);
  publish_outputs();
  if (!command.quiet && !command.json) print_written({command.picture});
}

void print_grid(const GridCommand& command, const GeneratedGrid& g) {
  print_findings(g.findings);
  const GridQuality& q = g.quality;
  const std::string start =
      g.folded_start > 0 ? brief(100 * g.folded_start) + " % of the cells folded" : "no cell folded";
  const std::string up = g.grid.dimension() == 3 ? " x " + std::to_string(g.grid.count[2]) : "";
  std::printf("grid      %d x %d%s nodes%s\n", g.grid.count[0], g.grid.count[1], up.c_str(),
              g.grid.periodic[0] ? ", round a ring" : "");
  std::printf("start     %s by transfinite interpolation\n", start.c_str());
  std::printf("steps     %d%s\n", g.iterations, g.converged ? "" : ", not converged");
  const std::vector<std::vector<std::string>> rows = {
      {"folded cells", std::to_string(q.folded)},
      {"smallest area", brief(q.smallest_area) + " of the mean"},
      {"angles", brief(q.smallest_angle) + " to " + brief(q.largest_angle) + " degrees"},
      {"mean skew", brief(q.skew) + " degrees from a right angle"},
      {"functional", brief(g.functional)}};
  std::puts("quality");
  std::fputs(table(rows, 2).c_str(), stdout);
  print_written(command.outputs);
  if (!command.picture.empty()) print_written({command.picture});
}

Json to_json(const GridCommand& command, const GeneratedGrid& g) {
  const GridQuality& q = g.quality;
  Json files = command.outputs;
  if (!command.picture.empty()) files.push_back(command.picture);
  return {{"region", command.region},
          {"nodes", {g.grid.count[0], g.grid.count[1], g.grid.count[2]}},
          {"periodic", g.grid.periodic[0]},
          {"folded_at_start", g.folded_start},
          {"folded_cells", q.folded},
          {"smallest_area", json_number(q.smallest_area)},
          {"smallest_angle_degrees", json_number(q.smallest_angle)},
          {"largest_angle_degrees", json_number(q.largest_angle)},
          {"mean_skew_degrees", json_number(q.skew)},
          {"functional", json_number(g.functional)},
          {"iterations", g.iterations},
          {"converged", g.converged},
          {"findings", json_findings(g.findings)},
          {"files", files}};
}

/// The other formats take the cells as triangles.
bool takes_grids(const std::string& path) { return extension_of(path) == ".vts"; }

void write_outputs(const GridCommand& command, const Grid& grid, const std::string& name) {
  SaveOptions form;
  form.name = name;
  for (const std::string& path : command.outputs)
    if (takes_grids(path))
      write_grid(grid, path);
    else
      save_all(mesh_of(grid), {path}, form);
  if (!command.picture.empty()) write_png(grid_lines_picture(grid, command.size), command.picture);
}

void make_grid(const GridCommand& command) {
  const Region region = load_region(command.region);
  GenerateOptions options;
  if (!command.nodes.empty()) options.nodes = parse_nodes(command.nodes);
  for (const std::string& path : command.outputs) takes_grids(path) ? expect_output(path) : check_mesh_path(path);
  if (!command.picture.empty()) check_picture_path(command.picture);
  const ThreadLimit threads(command.threads);
  const GeneratedGrid made = generate(region, options);
  write_outputs(command, made.grid, region.name);
  publish_outputs();
  if (command.json)
    print_json(to_json(command, made));
  else if (!command.quiet)
    print_grid(command, made);
}

void grid_command(const GridCommand& command) {
  if (command.list && !command.picture.empty()) check_picture_path(command.picture);
  if (command.list) command.json ? print_regions_as_json() : print_regions();
  if (command.list && !command.picture.empty()) draw_regions(command);
  if (command.list) return;
  if (command.region.empty()) throw Error(Fault::usage, "give a region, or --list for those that are built in");
  if (command.text)
    std::fputs(region_text(command.region).c_str(), stdout);
  else
    make_grid(command);
}

}  // namespace

Command add_grid(CLI::App& parent) {
  auto o = std::make_shared<GridCommand>();
  CLI::App* app = parent.add_subcommand(
      "grid",
      "Generate a grid that is fitted to the border of a region\n"
      "Lines of the grid follow the border, cross each other at angles as right as they can be, and bound cells of "
      "areas as even as they can be: Castillo's variational grid generation. Cells never fold.");
  app->add_option("REGION", o->region, "A built-in region, or the path of a region's .toml file")->type_name("");
  app->add_option(
         "-o,--output", o->outputs,
         "File for the grid: .vts, or its cells as triangles: .obj, .ply, .glb, ...; may be given several times")
      ->type_name("FILE");
  app->add_option("--nodes", o->nodes, "Nodes along both axes (default: those of the region)")
      ->type_name("ALONGxACROSS");
  app->add_option("--picture", o->picture, "Picture of the grid's lines: .png")->type_name("FILE");
  app->add_option("--picture-size", o->size, "Longer side of the picture in pixels (default: 1200)")
      ->type_name("N")
      ->check(whole_number(64, 16384));
  app->add_option("--threads", o->threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  app->add_flag("--list", o->list, "List the built-in regions; with --picture also draw them all");
  app->add_flag("--text", o->text, "Print the text of a built-in region, to begin one of your own");
  app->add_flag("--json", o->json, "Print the result as JSON");
  app->add_flag("-q,--quiet", o->quiet, "Print errors only");
  app->footer(
      "Examples:\n"
      "  pelage grid --list --picture all.png\n"
      "  pelage grid horseshoe --picture horseshoe.png\n"
      "  pelage grid swan --text > mine.toml\n"
      "  pelage grid mine.toml --nodes 200x100 -o mine.vts");
  return {app, [o] { grid_command(*o); }};
}

}  // namespace pelage
