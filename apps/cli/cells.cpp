// pelage cells: points spread over a shape, and the cells around them.

#include "shape/cells.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "base/parallel.h"
#include "command.h"
#include "look/cell_picture.h"
#include "outputs.h"
#include "pelage/render.h"
#include "picture_files.h"
#include "shape/cell_outlines.h"
#include "shape/soup_orient.h"
#include "soup_input.h"
#include "text.h"
#include "usage.h"
#include "view_options.h"

namespace pelage {

namespace {

struct CellsCommand {
  std::string shape, picture;
  std::vector<std::string> outputs;
  std::size_t count = 4000;
  int size = 1200;  ///< of the picture
  ViewOptions view;
  int threads = 0;
  bool json = false, quiet = false;
};

void report(const CellsCommand& command, const Cells& cells, const PolygonMesh& outlines, const CellMaker& maker) {
  const std::size_t outliers = maker.outliers();
  const double covered = maker.covered_share();
  const std::vector<double>&sides = outlines.find("sides")->values, &area = outlines.find("area")->values;
  double sum = 0;
  for (const double a : area) sum += a;
  const auto [smallest, largest] = std::ranges::minmax(area);
  const double mean = sum / static_cast<double>(area.size());
  const auto six = std::ranges::count(sides, 6.0);
  std::vector<std::string> files = command.outputs;
  if (!command.picture.empty()) files.push_back(first_picture(command.picture, command.view));
  if (command.json)
    return print_json({{"shape", command.shape},
                       {"cells", cells.nodes()},
                       {"area", json_number(sum)},
                       {"smallest_area_of_mean", json_number(smallest / mean)},
                       {"largest_area_of_mean", json_number(largest / mean)},
                       {"with_six_sides", six},
                       {"radius", json_number(cells.radius)},
                       {"outliers", outliers},
                       {"share_inside_other_parts", json_number(covered)},
                       {"files", files}});
  if (command.quiet) return;
  if (outliers > 0) std::printf("noted     %zu points are far from all others: no cells there\n", outliers);
  if (covered > 0)
    std::printf("noted     %s %% of the area lies inside other parts: no cells there\n", brief(100 * covered).c_str());
  std::printf("cells     %zu, %s world units apart\n", cells.nodes(), brief(cells.radius / 2).c_str());
  std::printf("area      %s in all; cells from %s to %s of the mean\n", brief(sum).c_str(),
              brief(smallest / mean).c_str(), brief(largest / mean).c_str());
  std::printf("sides     six at %s %% of the cells\n",
              brief(100 * static_cast<double>(six) / static_cast<double>(sides.size())).c_str());
  print_written(files);
}

void run_cells(const CellsCommand& command) {
  for (const std::string& path : command.outputs) check_mesh_path(path);
  if (!command.picture.empty()) check_picture_files(command.picture, command.view, command.size);
  const ThreadLimit threads(command.threads);
  ShapeFile file = read_for_cells(command.shape, {});
  if (file.nodes)
    throw Error(Fault::usage, command.shape + " has nodes of its own; cells are for polygons and clouds of points");
  if (!command.json && !command.quiet) print_findings(file.findings);
  orient_soup(file.mesh);
  const PictureOptions picture =
      picture_options(command.view, command.size, file.up, command.picture.empty() ? TriangleMesh{} : file.mesh);
  const CellMaker maker(std::make_shared<const TriangleMesh>(std::move(file.mesh)));
  const Cells cells = maker.make(command.count);
  const PolygonMesh outlines = outlines_of(cells);
  save_all(outlines, command.outputs, {});
  if (!command.picture.empty()) {
    PictureScene scene(cells_to_see(cells));
    take_pictures(command.picture, command.view, picture, [&](const PictureOptions& p) { return scene.render(p); });
  }
  publish_outputs();
  report(command, cells, outlines, maker);
}

}  // namespace

Command add_cells(CLI::App& parent) {
  auto o = std::make_shared<CellsCommand>();
  CLI::App* app = parent.add_subcommand(
      "cells",
      "Scatter points evenly over a shape and show the cells around them\n"
      "The shape may be any polygons, also such that do not fit together, or a cloud of points. With --method cells a "
      "pattern grows on these.");
  app->add_option("SHAPE", o->shape, "The shape's file, or builtin:NAME")->type_name("")->required();
  app->add_option("-n,--number", o->count, "How many (default: 4000)")
      ->type_name("N")
      ->check(whole_number(static_cast<std::int64_t>(fewest_cells), static_cast<std::int64_t>(most_cells)));
  app->add_option("-o,--output", o->outputs,
                  "File for the cells as polygons, with their points as the first vertices: .ply, .obj, .vtp, ...; may "
                  "be given several times")
      ->type_name("FILE");
  app->add_option("--picture", o->picture,
                  "Picture of the cells: .png or .exr; blue have fewer than six sides, red more")
      ->type_name("FILE");
  app->add_option("--picture-size", o->size, "Width and height of the picture in pixels (default: 1200)")
      ->type_name("N")
      ->check(whole_number(64, 16384));
  add_view_options(*app, o->view);
  add_turntable_option(*app, o->view);
  app->add_option("--threads", o->threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  app->add_flag("--json", o->json, "Print the result as JSON");
  app->add_flag("-q,--quiet", o->quiet, "Print errors only");
  app->footer(
      "Examples:\n"
      "  pelage cells cow.obj -n 4000 -o cells.ply --picture cells.png\n"
      "  pelage cells scan.ply -n 20000 --picture scan.png");
  return {app, [o] { run_cells(*o); }};
}

}  // namespace pelage
