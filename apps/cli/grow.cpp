// pelage grow: a shape goes in, a coated mesh and a picture come out.

#include <algorithm>
#include <memory>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/suggest.h"
#include "catalog/bind.h"
#include "catalog/images.h"
#include "catalog/recipes.h"
#include "command.h"
#include "film.h"
#include "grow_files.h"
#include "grow_run.h"
#include "grown_coat.h"
#include "input_unit.h"
#include "io/file_bytes.h"
#include "io/output_set.h"
#include "look/grid_picture.h"
#include "look/solid_tessellation.h"
#include "look/tessellation.h"
#include "node_outputs.h"
#include "pelage/io.h"
#include "picture_files.h"
#include "run/checkpoint.h"
#include "soup_input.h"
#include "space_time.h"
#include "text.h"

namespace pelage {

namespace {

PictureOptions picture_of(const GrowOptions& options, const Quality& quality, UpAxis up, const TriangleMesh& shape) {
  const bool drawn = options.frames || !options.picture.empty() || !options.panels.empty();
  PictureOptions picture = picture_options(options.view, options.picture_size, up, drawn ? shape : TriangleMesh{});
  picture.samples = quality.picture_samples;
  return suited_to(options.picture, picture);
}

void require_line(const ShapeFile& file) {
  if (const Grid* grid = as<Grid>(file.nodes); !grid || grid->dimension() != 1)
    throw Error(Fault::usage,
                "--plot shows what a line does in the course of time; take builtin:line?n=60 for the shape");
}

/// As high as it may be; nodes become blocks of pixels where there is room.
Image space_time_plot(const SpaceTime& plot, const Run& run, const Look& look, int size) {
  const int across = std::max(1, size / static_cast<int>(run.space().unknowns()));
  return zoomed(plot.picture(run, look, std::max(1, size / across)), across, across);
}

GrowReport::Form form_of(const GrowOptions& options) {
  if (options.json) return GrowReport::Form::json;
  return options.quiet ? GrowReport::Form::nothing : GrowReport::Form::lines;
}

/// As a finished run calls its fields.
std::vector<std::string> names_of_species(const Plan& planned) {
  std::vector<std::string> names;
  for (const PlannedStage& stage : planned.stages)
    for (std::size_t i = 0; i < stage.model.species_count(); ++i)
      names.push_back((&stage == &planned.stages.back() ? "" : stage.asked.name.value + ".") +
                      stage.model.species_name(i));
  return names;
}

/// What to cut away of a volume.
Carving carving_of(const GrowOptions& options, const Plan& planned, UpAxis up) {
  Carving carving;
  for (const std::string& text : options.cuts) carving.cuts.emplace_back(text, up);
  if (!options.isosurface) return carving;
  carving.part = parse_level_part(*options.isosurface);
  const std::vector<std::string> known = names_of_species(planned);
  if (std::ranges::count(known, carving.part->species) == 0)
    throw Error(Fault::usage, "--isosurface: " + unknown_name("species", carving.part->species, known));
  return carving;
}

/// What a shape of that kind has not: before any work.
void check_kind(const GrowOptions& options, const Look& look, const ShapeFile& file, const Carving& carving) {
  const bool cut = !options.cuts.empty() || options.isosurface;
  if (file.nodes && (look.flat || look.keep_shape || look.detail.value_or(0) > 0)) {
    if (!shows_surface(file.nodes))
      throw Error(Fault::usage, "the shape is coloured at its own nodes: leave --flat, --keep-shape and --detail out");
    if (cut)
      throw Error(Fault::usage,
                  "--cut and --isosurface show other surfaces than that of the shape: leave --flat, --keep-shape and "
                  "--detail out");
  }
  if (file.nodes && look.displace)
    throw Error(Fault::usage, "--displace moves the vertices of surfaces; the nodes of this shape stay where they are");
  if (cut && !options.lines.files.empty())
    throw Error(Fault::usage, "--lines are those of the shape's surface: leave --cut and --isosurface out");
  for (const std::string& path : options.outputs)
    if (is_node_output(path)) check_node_output(path, file.nodes.get());
  if (cut && !is_volume(file.nodes.get()))
    throw Error(Fault::usage,
                "--cut and --isosurface show the inside of volumes, and the shape is none; take for example "
                "builtin:box?n=64x64x64 or a .vtu or .msh file");
  if (options.frames && is_volume(file.nodes.get()))
    throw Error(Fault::usage, "--frames is for surfaces and grids; of a volume only the end is shown");
  if (!carving.cuts.empty() && !leaves_something(*file.nodes, file.mesh.points, carving.cuts))
    throw Error(Fault::usage, "--cut leaves nothing of the shape, which pelage check describes");
  if (!file.nodes && file.mesh.triangles.empty())
    for (const std::string& path : options.outputs)
      if (const std::string kind = lower_extension(path); kind == ".glb" || kind == ".stl")
        throw Error(Fault::usage, path + ": a cloud of points has no triangles for a file of this kind; take .ply");
}

/// Whether the method that is asked for is one for shapes of that kind.
template <class Kind>
bool is_for(const Plan& planned) {
  return planned.method->fits && planned.method->fits(Kind{});
}

ShapeFile read_input(const GrowOptions& options, const std::string& shape, const Plan& planned,
                     const std::vector<Texture>& images, const Progress& progress) {
  ShapeFile file =
      is_for<Cells>(planned) ? read_for_cells(shape, options.input_unit) : read_shape(shape, options.input_unit);
  if (is_for<TetMesh>(planned)) progress("filling", 0);
  fill_solid(planned, file, images);
  return file;
}

/// Of all that a coat and its files take while they are made, measured, on surfaces and on nodes [bytes].
constexpr double coat_triangle = 400, node_triangle = 250;

/// Tells what is going to be needed, and refuses the coat for which there is no room; World refuses the growth.
void foresee(const Program& program, const CoatRequest& request, GrowReport& report) {
  const Forecast growth = forecast(program);
  const Look& look = request.look;
  const auto shape = static_cast<double>(shape_of(program)->triangles.size());
  const double triangles =
      program.nodes || look.keep_shape ? shape : most_tessellated(tessellation_request(look), growth.triangles, shape);
  const double coat = (program.nodes ? node_triangle : coat_triangle) * triangles;
  report.need(growth, std::max(growth.bytes, coat));
  if (look.detail)
    require_memory(coat, "a coat of " + brief(triangles) + " triangles", "a --detail of less by one needs a quarter");
}

void grow_run(const GrowOptions& options, Run& run, const CoatRequest& request, CheckpointFile& saved,
              const Progress& progress, GrowReport& report) {
  check_coat(request);
  set_out(run, options, progress, report);
  const Stopwatch growth;
  SpaceTime plot;
  Observer plotting;
  if (!options.plot.empty()) {
    require_line(request.file);
    plot.add(run);
    plotting = [&plot](const Run& now) { plot.add(now); };
  }
  grow_to_the_end(run, options, plotting, saved, progress, report);
  report.growth(run, growth.seconds());
  if (run.world().surface()) report.surface(*run.world().surface());
  if (!options.checkpoint.empty()) report.file(options.checkpoint);
  if (!options.plot.empty()) {
    write_png(space_time_plot(plot, run, request.look, options.picture_size), options.plot);
    report.file(options.plot);
  }
  if (request.look.keep_shape) report.coarseness(run);
}

/// The run and its matrices are gone when the coat is drawn.
Grown coat_of(std::unique_ptr<Run> run, const CoatRequest& request, const Progress& progress, GrowReport& report) {
  const CoatFields fields = run->fields();
  const std::shared_ptr<const TriangleMesh> shape = shape_of(run->program());
  run.reset();
  return grown_coat(fields, shape, request, progress, report);
}

void record_end(const StageProgram& stage, const std::string& of) {
  record_value("until" + of, exact_number(stage.until));
  if (stage.steps) record_value("steps" + of, std::to_string(*stage.steps));
  record_value("stationary" + of, exact_number(stage.stationary));
}

/// What the words of the command mean, for the files' own account of themselves.
void record_meaning(const GrowOptions& options, const Recipe& recipe, const Program& program) {
  record_value("quality", recipe.quality.value);
  for (const Trait& trait : told(traits_of(program))) record_value(trait.name, trait.value);
  for (const StageProgram& stage : program.stages)
    record_end(stage, program.stages.size() > 1 ? " of stage " + stage.name : "");
  if (options.recipe && !options.recipe->ends_with(".toml"))
    record_source(*options.recipe, recipe_text(*options.recipe));
}

void grow(const GrowOptions& options) {
  const Recipe recipe = make_recipe(options);
  const Plan planned = plan(recipe);
  check_outputs(options, recipe.shape);
  if (!options.panels.empty() && !recipe.motion.fair)
    throw Error(Fault::usage, "--panels shows what --fair does; give it too");
  check_lines(options.lines, names_of_species(planned));
  check_inputs(options, recipe);
  std::optional<Film> film;
  if (options.frames) film.emplace(options, planned);
  require_outputs(options);
  catch_interrupts();
  const ThreadLimit threads(options.threads.value_or(0));
  ProgressBar bar(options.quiet ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  Profile profile;
  const Progress progress = profile.measured(bar.progress());
  GrowReport report(form_of(options), bar);
  const Stopwatch total;

  progress("reading " + recipe.shape, 0);
  std::vector<Texture> images = read_images(recipe.textures);
  ShapeFile file = read_input(options, recipe.shape, planned, images, progress);
  report.shape(recipe.shape, file);
  const UpAxis up = options.view.up.value_or(file.up);
  const Carving carving = carving_of(options, planned, up);
  check_kind(options, recipe.look, file, carving);
  std::optional<ShapeFile> onto = read_onto(options, recipe, file, progress, report);
  ShapeFile& imaged = onto ? *onto : file;
  make_atlas(options, recipe, imaged, progress, report);
  if (options.print.any() && is_for<Cells>(planned))
    throw Error(Fault::usage,
                "--perforate and --thicken cut whole surfaces; cells may lie on any: take another --method");
  check_print(options.print, recipe.look, file, wants_images(options), names_of_species(planned));
  const std::optional<UvLayout> layout = layout_of(options, imaged, report);
  if (layout) require_memory(*layout, recipe.look, onto || recipe.look.channels.contains(Channel::height));
  if (!recipe.look.keep_shape && !layout) file.source.reset();

  const CoatRequest request{options, recipe.look, file, layout, onto, carving};
  std::shared_ptr<const Program> program;
  auto run = interruptible("before the growth began; nothing was written", [&] {
    program = std::make_shared<const Program>(bind_plan(planned, file, std::move(images)));
    foresee(*program, request, report);
    record_meaning(options, recipe, *program);
    return std::make_unique<Run>(program, World(program, progress), progress);
  });
  CheckpointFile saved(options.checkpoint, options.every_minutes);
  grow_run(options, *run, request, saved, progress, report);
  SaveOptions form{object_name(file, recipe.shape), up};
  if (onto && options.bake) form = {object_name(*onto, options.onto), options.view.up.value_or(onto->up)};
  form.compress = options.compress;
  if (film) {
    film->end_with(*run, recipe.look);
    const PictureOptions picture = picture_of(options, *planned.quality, up, *shape_of(run->program()));
    run.reset();
    film->shoot(program, {recipe.look, file, picture, form}, progress, report);
  } else {
    const Grown grown = coat_of(std::move(run), request, progress, report);
    write_files(options, grown, file, recipe.look.keep_shape, form, progress, report);
    write_pictures(options, recipe, grown, file, picture_of(options, *planned.quality, up, *grown.shape), progress,
                   report);
  }
  if (options.profile) report.profile(profile);
  report.end(total.seconds());
  saved.finish();
}

}  // namespace

Command add_grow(CLI::App& parent) {
  auto options = std::make_shared<GrowOptions>();
  CLI::App* app = parent.add_subcommand(
      "grow",
      "Grow a coat on a shape and write a coated mesh, a picture or both\n"
      "The spacing of the pattern is set by --size alone; a mesh that is too coarse for it is refined on its "
      "smooth surface.");
  add_options(*app, *options);
  app->footer(
      "Examples:\n"
      "  pelage grow cow.obj --size 0.04 -o cow.glb,cow.ply --picture cow.png\n"
      "  pelage grow horse.off --model gray-scott:spots --ramp leopard --keep-shape -o horse.ply\n"
      "  pelage grow part.stl --size 4mm --up z --set s=0.06 -o part.vtp\n"
      "  pelage grow scan.ply --fair -o coat.glb --panels panels.png\n"
      "  pelage grow --recipe demo -o cub.glb");
  return {app, [options] { grow(*options); }};
}

}  // namespace pelage
