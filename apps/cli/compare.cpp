// pelage compare: how far a mesh is from a reference.

#include "fair/compare.h"

#include <cstdio>
#include <memory>

#include "command.h"
#include "input_unit.h"
#include "pelage/io.h"
#include "text.h"

namespace pelage {

namespace {

struct CompareOptions {
  std::string shape, reference;
  bool json = false;
};

Json to_json(const Comparison& c) {
  Json normals = nullptr;
  if (c.normals)
    normals = {{"mean_degrees", json_number(c.normals->mean)},
               {"sharp_degrees", json_number(c.normals->sharp)},
               {"quantile95_degrees", json_number(c.normals->quantile95)},
               {"flipped", c.normals->flipped}};
  return {{"normals", normals},
          {"distance", json_number(c.distance)},
          {"largest_distance", json_number(c.largest_distance)},
          {"volume_change", json_number(c.volume_change)}};
}

void print(const Comparison& c) {
  if (c.normals) {
    std::printf("normals   %s degrees off in the mean, %s at sharp edges, %s for 95 %% of the faces\n",
                brief(c.normals->mean).c_str(), brief(c.normals->sharp).c_str(), brief(c.normals->quantile95).c_str());
    std::printf("flipped   %zu faces\n", c.normals->flipped);
  } else {
    std::puts("normals   not compared: the meshes have different triangles");
  }
  std::printf("distance  %s of the diagonal (root mean square), %s at most\n", brief(c.distance).c_str(),
              brief(c.largest_distance).c_str());
  std::printf("volume    %+.3g %%\n", 100 * c.volume_change);
}

void run_compare(const CompareOptions& options) {
  const Comparison result = compare(read_surface(options.shape).mesh, read_surface(options.reference).mesh);
  if (options.json) return print_json(to_json(result));
  print(result);
}

}  // namespace

Command add_compare(CLI::App& parent) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* app = parent.add_subcommand(
      "compare",
      "Measure how far a mesh is from a reference\n"
      "Angles between the normals of corresponding triangles (if both meshes have the same ones), distance of the "
      "vertices from the reference's surface, and change of volume.");
  app->add_option("SHAPE", options->shape, "The mesh to be judged")->required()->type_name("");
  app->add_option("REFERENCE", options->reference, "What it should be")->required()->type_name("");
  app->add_flag("--json", options->json, "Print the result as JSON");
  app->footer("Example:\n  pelage compare clean.ply truth.ply");
  return {app, [options] { run_compare(*options); }};
}

}  // namespace pelage
