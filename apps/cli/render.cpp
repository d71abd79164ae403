// pelage render: a scene of several things becomes a picture.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/parallel.h"
#include "catalog/quality.h"
#include "catalog/scenes.h"
#include "command.h"
#include "interrupt.h"
#include "io/output_set.h"
#include "look/ramp.h"
#include "picture_files.h"
#include "progress_bar.h"
#include "settings.h"
#include "text.h"
#include "usage.h"
#include "view_options.h"

namespace pelage {

namespace {

struct RenderCommand {
  std::string scene, output, quality;
  int size = 1024;
  ViewOptions view;
  std::optional<int> threads;
  bool list = false, quiet = false;
};

PictureOptions picture_of(const RenderCommand& o, const Scene& scene, BuiltScene& built) {
  PictureOptions picture = picture_options(o.view, o.size, UpAxis::y, {});
  if (!picture.camera) {
    set_proportions(picture, o.size, scene.camera.aspect);
    if (!o.view.lens) picture.angle = scene.camera.angle;
  }
  picture.azimuth = o.view.azimuth.value_or(o.view.from_front.value_or(scene.camera.azimuth));
  picture.elevation = o.view.elevation.value_or(scene.camera.elevation);
  picture.exposure = scene.exposure + o.view.exposure;
  picture.margin = scene.camera.margin;
  picture.lamp = {scene.lamp.azimuth, scene.lamp.elevation, scene.lamp.size};
  if (scene.background && !o.view.background) try {
      picture.background = parse_hex_color(scene.background->value);
    } catch (const Error& error) {
      throw Error(Fault::usage, error.what(), scene.background->where);
    }
  picture.framed = std::move(built.framed);
  return picture;
}

void list_scenes() {
  for (const std::string& name : scene_names())
    std::printf("%-12s %s\n", name.c_str(), load_scene(name).summary.c_str());
}

void run_render(const RenderCommand& o) {
  if (o.list) return list_scenes();
  if (o.scene.empty()) throw Error(Fault::usage, "which scene? pelage render --list shows the built-in ones");
  if (o.output.empty()) throw Error(Fault::usage, "give a file for the picture: -o scene.png");
  check_picture_files(o.output, o.view, o.size);
  const Scene scene = load_scene(o.scene);
  catch_interrupts();
  const ThreadLimit threads(o.threads.value_or(0));
  ProgressBar bar(o.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  const Progress progress = bar.progress();
  BuiltScene built = build_scene(scene, o.quality, progress);
  PictureOptions picture = picture_of(o, scene, built);
  if (o.quality == "draft") picture.samples = 8;
  if (o.quality == "fine") picture.samples = 128;
  const std::size_t triangles = built.mesh.triangles.size();
  PictureScene stage(std::move(built.mesh));
  const PictureFile file = take_pictures(o.output, o.view, picture, [&](const PictureOptions& p) {
    return stage.render(p,
                        [&](std::string_view, double fraction) { return progress("drawing " + o.output, fraction); });
  });
  publish_outputs();
  bar.clear();
  if (!o.quiet)
    std::printf("wrote     %s (%s%zu triangles)\n", file.path.c_str(),
                file.about.empty() ? "" : (file.about + "; ").c_str(), triangles);
}

}  // namespace

Command add_render(CLI::App& parent) {
  auto o = std::make_shared<RenderCommand>();
  CLI::App* app = parent.add_subcommand(
      "render",
      "Draw a scene of several things, with coats that grow on them\n"
      "A scene is a text file: shapes in their places, recipes, materials, camera and lamp (docs/scenes.md).");
  app->add_option("SCENE", o->scene, "A built-in scene, or a .toml file")->type_name("");
  app->add_flag("--list", o->list, "Print the built-in scenes");
  app->add_option("-o,--output", o->output, "File for the picture: .png, or .exr in linear light")->type_name("FILE");
  app->add_option("--picture-size", o->size, "The longer side of the picture, pixels (default: 1024)")
      ->type_name("N")
      ->check(whole_number(64, 16384));
  app->add_option("--quality", o->quality,
                  "How accurate coats and picture are: draft, normal (noise below 4 steps of 255) or fine")
      ->type_name("NAME")
      ->check(CLI::IsMember({"draft", "normal", "fine"}));
  add_view_options(*app, o->view);
  add_turntable_option(*app, o->view);
  app->remove_option(app->get_option("--up"));
  app->add_option("--threads", o->threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  app->add_flag("-q,--quiet", o->quiet, "Print errors only");
  app->footer(
      "Examples:\n"
      "  pelage render --list\n"
      "  pelage render glassware -o glassware.png\n"
      "  pelage render table.toml --picture-size 2048 -o table.png\n"
      "  pelage render glassware --turntable 100 -o glassware.mp4");
  return {app, [o] { run_render(*o); }};
}

}  // namespace pelage
