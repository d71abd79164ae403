// pelage grow: a shape goes in, a coated mesh and a picture come out.

#include <algorithm>
#include <chrono>
#include <memory>

#include "base/parallel.h"
#include "base/suggest.h"
#include "catalog/bind.h"
#include "catalog/images.h"
#include "command.h"
#include "grow_options.h"
#include "grow_report.h"
#include "input_unit.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/gltf_coat.h"
#include "io/write_mesh.h"
#include "look/carving.h"
#include "look/grid_picture.h"
#include "look/sheet_image.h"
#include "look/solid_tessellation.h"
#include "node_outputs.h"
#include "panels.h"
#include "pelage/io.h"
#include "progress_bar.h"
#include "run/nested.h"
#include "shape/split_corners.h"
#include "shape/triangulate.h"
#include "soup_input.h"
#include "space_time.h"
#include "text.h"
#include "texture_outputs.h"

namespace pelage {

namespace {

/// The program looks at Ctrl-C and the bar about so often, as long as single steps are shorter [s].
constexpr double slice = 0.1;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// How long a growth will take, by the speed of its first steps.
class GrowthClock {
 public:
  /// Of all stages [s]; once, when it is known.
  std::optional<double> estimate(const Run& run) {
    constexpr double watched = 0.15;
    const auto iterations = static_cast<double>(run.summary().iterations);
    const double now = watch_.seconds();
    if (told_ || run.stage() > 0 || run.done()) return {};
    if (seconds_ < 0) {  // the first step sets up the solver
      seconds_ = now;
      iterations_ = iterations;
    }
    if (now - seconds_ < watched || !(iterations > iterations_)) return {};
    told_ = true;
    double rest = -iterations;
    for (const StageProgram& p : run.program().stages) {
      if (!p.iterations) return {};
      rest += *p.iterations;
    }
    return now + std::max(0.0, rest) * (now - seconds_) / (iterations - iterations_);
  }

 private:
  Stopwatch watch_;
  double seconds_ = -1, iterations_ = 0;  ///< after the first step
  bool told_ = false;
};

/// work(), with a message for people when it is cancelled.
template <class Work>
auto interruptible(const std::string& when, Work&& work) {
  try {
    if (interrupt_signal()) throw Error(Fault::cancelled, "");
    return work();
  } catch (const Error& error) {
    if (error.fault() != Fault::cancelled) throw;
    throw Error(Fault::cancelled, "interrupted " + when);
  }
}

void restore(Run& run, const std::string& path) {
  if (path.empty()) return;
  const std::string bytes = read_file(path);
  try {
    run.restore(bytes);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
}

void begin_nested(Run& run, const Progress& progress, GrowReport& report) {
  const int grids =
      interruptible("before the growth began; nothing was written", [&] { return grow_nested(run, progress); });
  if (grids == 0)
    report.warning(
        "--nested changes nothing: it takes an even grid with an even number of nodes along periodic axes and an odd "
        "one along others, and six of every second node for the wavelength");
}

[[noreturn]] void interrupted(const Run& run, const std::string& checkpoint) {
  const std::string stage = run.program().stages.size() > 1 ? "stage " + run.stage_program().name + ", " : "";
  const std::string place = "interrupted at " + stage + std::to_string(run.summary().steps) + " steps, time " +
                            number(run.summary().time) + "; no mesh or picture was written";
  if (checkpoint.empty()) throw Error(Fault::cancelled, place + "; with --checkpoint FILE it could go on from here");
  throw Error(Fault::cancelled, place + "; go on with --resume " + checkpoint);
}

/// So many steps that they take about one slice, growing slowly since the steps of a settling pattern differ.
std::int64_t next_steps(std::int64_t steps, double seconds) {
  const double wanted = static_cast<double>(steps) * slice / std::max(seconds, 1e-6);
  return std::clamp(static_cast<std::int64_t>(wanted), std::int64_t{1}, 2 * steps);
}

/// Where Ctrl-C comes while a stage begins, the run stays at the end of the one before.
void advance(Run& run, std::int64_t steps) {
  try {
    run.advance(steps);
  } catch (const Error& error) {
    if (error.fault() != Fault::cancelled) throw;
  }
}

/// `plot`: to be told of every step, or null.
void grow_to_the_end(Run& run, const GrowOptions& options, SpaceTime* plot, const Progress& progress,
                     GrowReport& report) {
  std::int64_t steps = 1;
  GrowthClock clock;
  while (!run.done() && progress("growing", run.fraction())) {
    const Stopwatch watch;
    advance(run, steps);
    if (plot)
      plot->add(run);
    else
      steps = next_steps(steps, watch.seconds());
    report.warnings(run);
    if (const auto seconds = clock.estimate(run)) report.estimate(run, *seconds);
  }
  if (run.summary().status == RunStatus::failed) throw Error(Fault::numerics, run.summary().message);
  if (!options.checkpoint.empty()) write_file(options.checkpoint, run.checkpoint());
  if (interrupt_signal()) interrupted(run, options.checkpoint);
}

/// How the coat was written.
struct Saving {
  std::vector<std::string> files;   ///< more than one where an image lies beside it
  std::string about;                ///< what a reader must know beside it
  std::vector<std::string> losses;  ///< what it cannot hold
};

void write_outputs(const std::vector<std::string>& paths, const std::function<Saving(const std::string&)>& save_as,
                   const Progress& progress, GrowReport& report) {
  for (const std::string& path : paths) {
    progress("writing " + path, 0);
    Saving saving;
    interruptible("before " + path + " was written", [&] { saving = save_as(path); });
    for (const std::string& file : saving.files) report.file(file, saving.about);
    for (const std::string& loss : saving.losses) report.warning(path + ": " + loss);
  }
}

template <class Mesh>
Saving save_mesh(const Mesh& coat, const std::string& path, const SaveOptions& form) {
  save(coat, path, form);
  return {{path}, "", losses(coat, extension_of(path))};
}

bool has_corner_normals(const TriangleMesh& coat) {
  const Attribute* normal = coat.find("normal");
  return normal && normal->domain == Domain::corner;
}

/// Where normals belong to corners of their own, the surface stays closed; elsewhere it does so without them.
Saving save_surface(TriangleMesh coat, const std::string& path, const SaveOptions& form) {
  const std::string extension = lower_extension(path);
  if (has_corner_normals(coat) && extension != ".glb" && extension != ".obj")
    std::erase_if(coat.attributes, [](const Attribute& a) { return a.name == "normal"; });
  return save_mesh(coat, path, form);
}

/// Built-in shapes are of no other form.
SourceShape form_of_shape(const ShapeFile& file, const TriangleMesh& shape) {
  if (file.source) return *file.source;
  PolygonMesh polygons = polygons_of(shape);
  std::vector<std::int32_t> vertex(polygons.corners.begin(), polygons.corners.end());
  return {std::move(polygons), std::move(vertex)};
}

/// The file's own mesh and attributes with what the coat adds to them.
PolygonMesh kept_shape(SourceShape source, const TriangleMesh& coat, const Paint& paint) {
  rename_input(source.polygons.attributes, paint);
  TriangleMesh added = coat;
  std::erase_if(added.attributes, [&](const Attribute& a) { return source.polygons.find(a.name) != nullptr; });
  return as_in_file(source, added);
}

void write_picture(const std::string& path, const Progress& progress, GrowReport& report,
                   const std::function<Image(const Progress&)>& draw) {
  if (path.empty()) return;
  const std::string task = "drawing " + path;
  const auto drawing = [&] {
    return draw([&](std::string_view, double fraction) { return progress(task, fraction); });
  };
  write_png(interruptible("before " + path + " was written", drawing), path);
  report.file(path);
}

PictureOptions picture_of(const GrowOptions& options, const Quality& quality, UpAxis up) {
  PictureOptions picture = picture_options(options.view, options.picture_size, up);
  picture.samples = quality.picture_samples;
  return picture;
}

GrowReport::Form form_of(const GrowOptions& options) {
  if (options.json) return GrowReport::Form::json;
  return options.quiet ? GrowReport::Form::nothing : GrowReport::Form::lines;
}

/// The coat when it has grown, and the shape as it was given. The run and its matrices are gone when pictures are
/// drawn.
struct Grown {
  TriangleMesh coat;                     ///< as it is shown
  std::optional<Image> image;            ///< instead of the coat, where nothing else is asked for
  std::optional<TriangleMesh> at_nodes;  ///< of a volume, what files of these have
  std::shared_ptr<const TriangleMesh> shape;
  Paint paint;
  std::shared_ptr<const NodeShape> nodes;  ///< of the run, which may be made of the file's surface
  std::optional<PatchTexture> patches;     ///< where they are asked for
  std::optional<CoatTextures> textures;    ///< likewise
  std::optional<PolygonMesh> textured;     ///< the mesh that shows these
};

int texture_size(const GrowOptions& options) { return options.bake.value_or(default_texture); }

/// Of patches: whether any output shows images of them; checks that these have room.
bool wants_patches(const GrowOptions& options, const ShapeFile& file) {
  const Atlas* atlas = as<Atlas>(file.nodes);
  const bool wanted = wants_images(options) || !options.patch_images.empty() ||
                      std::ranges::any_of(options.outputs, [](const std::string& o) { return is_node_output(o); });
  if (!atlas || !wanted) return false;
  lay_out(*atlas, texture_size(options));
  return true;
}

/// Of surfaces, where images are asked for; warns of what is unusual.
std::optional<UvLayout> layout_of(const GrowOptions& options, const ShapeFile& file, GrowReport& report) {
  if (!wants_images(options) || as<Atlas>(file.nodes)) return {};
  if (file.nodes && !as<Cells>(file.nodes))
    throw Error(Fault::usage, "--bake and --maps are for surfaces with uv and for patches, and the shape is neither");
  std::optional<UvLayout> layout = uv_layout(file.mesh, texture_size(options));
  for (const std::string& line : lines_of(layout->notes(), file.mesh, file.source.get())) report.warning(line);
  return layout;
}

Saving save_with_textures(const Grown& grown, const std::string& path, const SaveOptions& form) {
  PolygonMesh mesh = grown.textured ? *grown.textured : polygons_of(grown.coat);
  std::vector<std::string> files = save_textured(mesh, path, form, *grown.textures);
  erase_imaged(mesh.attributes);
  return {std::move(files), "", losses(mesh, extension_of(path))};
}

/// The file's own mesh as it is cut into triangles; where repairs have changed those, the one of the run.
TriangleMesh shaded_mesh(const PolygonMesh& textured, const TriangleMesh& shape) {
  std::vector<Finding> ignored;
  TriangleMesh mesh = triangulate(textured, ignored).mesh;
  return mesh.triangles.size() == shape.triangles.size() ? mesh : shape;
}

/// The coat on the surface that it has grown on, as images on the file's own mesh.
void bake_surface(const CoatFields& fields, const Look& look, const UvLayout& layout, const ShapeFile& file,
                  Grown& grown, GrowReport& report) {
  const Cells* cells = as<Cells>(fields.nodes);
  const TriangleMesh& shape = cells ? *cells->on : *grown.shape;
  Look as_given = look;
  as_given.keep_shape = true;
  grown.textured = kept_shape(form_of_shape(file, shape), dress(fields, as_given), grown.paint);
  std::optional<ShadingFrames> frames;
  if (grown.paint.channels.contains(Channel::height)) frames.emplace(shaded_mesh(*grown.textured, shape));
  Look smooth = look;
  smooth.keep_shape = false;
  const Tessellation t = tessellate(fields, tessellation_request(smooth, grown.paint));
  BakedCoat baked = bake(CoatSampler(fields, t, grown.paint), make_palette(grown.paint, t.samples, fields.uniform),
                         layout, frames ? &*frames : nullptr);
  for (const std::string& line : lines_of({baked.hidden}, shape, file.source.get())) report.warning(line);
  grown.textures = textures_of(std::move(baked), layout);
}

void require_line(const ShapeFile& file) {
  if (const Grid* grid = as<Grid>(file.nodes); !grid || grid->dimension() != 1)
    throw Error(Fault::usage,
                "--plot shows what a line does in the course of time; take builtin:line?n=60 for the shape");
}

void require_sheet(const ShapeFile& file) {
  if (const Grid* grid = as<Grid>(file.nodes); !grid || grid->dimension() == 3)
    throw Error(Fault::usage, "--height-map is for sheets of grids, a pixel for each node; a block has no height");
}

/// What the look says of the height, or else the shown species.
void write_relief(const Grid& sheet, const CoatFields& fields, const Look& look, const std::string& path,
                  GrowReport& report) {
  const Paint paint = resolve_paint(look, fields.species);
  if (!paint.channels.contains(Channel::height)) {
    save_height_map(sheet, fields.coefficients[paint.shown], path);
    return report.file(path);
  }
  const CoatSamples nodes = samples_at_nodes(fields, tessellation_request(look, paint));
  const std::vector<double> height = channel_values(nodes, paint, Channel::height);
  save_height_map(sheet, height, path);
  const auto [low, high] = std::ranges::minmax(height);
  report.file(path, "black is " + number(low) + " and white " + number(high) + " above the sheet");
}

TriangleMesh dressed(const CoatFields& fields, const Look& look, const Paint& paint, GrowReport& report) {
  Tessellation t = tessellate(fields, tessellation_request(look, paint));
  for (const std::string& line : clamped_channels(t.samples, paint)) report.warning(line);
  return dress(std::move(t), paint, fields.uniform);
}

/// As high as it may be; nodes become blocks of pixels where there is room.
Image space_time_plot(const SpaceTime& plot, const Run& run, const Look& look, int size) {
  const int across = std::max(1, size / static_cast<int>(run.space().unknowns()));
  return zoomed(plot.picture(run, look, std::max(1, size / across)), across, across);
}

/// Whether a coat on a sheet is asked for as nothing but pixels.
bool only_images(const GrowOptions& options, const Look& look) {
  return options.panels.empty() && !look.keep_shape &&
         std::ranges::all_of(options.outputs, [](const auto& path) { return lower_extension(path) == ".png"; });
}

Grown grown_coat(const GrowOptions& options, const Plan& planned, const Look& look, ShapeFile& file,
                 std::vector<Texture> images, Carving carving, const std::optional<UvLayout>& layout,
                 const Progress& progress, GrowReport& report) {
  auto own = interruptible("before the growth began; nothing was written", [&] {
    return std::make_unique<Run>(bind_plan(planned, file, std::move(images)), progress);
  });
  Run& run = *own;
  const bool patches = wants_patches(options, file);
  if (!options.height_map.empty()) require_sheet(file);
  if (options.nested) begin_nested(run, progress, report);
  restore(run, options.resume);
  report.warnings(run);
  report.pattern(run);
  const Stopwatch growth;
  SpaceTime plot;
  if (!options.plot.empty()) {
    require_line(file);
    plot.add(run);
  }
  grow_to_the_end(run, options, options.plot.empty() ? nullptr : &plot, progress, report);
  report.growth(run, growth.seconds());
  if (run.world().surface()) report.surface(*run.world().surface());
  if (!options.checkpoint.empty()) report.file(options.checkpoint);
  progress("colouring", 0);
  const CoatFields fields = run.fields();
  if (!options.plot.empty()) {
    write_png(space_time_plot(plot, run, look, options.picture_size), options.plot);
    report.file(options.plot);
  }
  if (look.keep_shape) report.coarseness(run);
  if (!options.height_map.empty()) write_relief(*as<Grid>(file.nodes), fields, look, options.height_map, report);
  Grown grown{{}, {}, {}, shape_of(run.program()), resolve_paint(look, fields.species), fields.nodes, {}, {}, {}};
  own.reset();
  if (only_images(options, look) && is_bare_sheet(fields)) {
    grown.image = sheet_image(fields, look);
    return grown;
  }
  if (is_volume(fields.nodes.get())) {
    if (const std::string other = fit_level(carving, fields); !other.empty()) report.warning(other);
    for (const std::string& line :
         clamped_channels(samples_at_nodes(fields, tessellation_request(look, grown.paint)), grown.paint))
      report.warning(line);
    grown.coat = dress_body(fields, look, carving);
    if (std::ranges::any_of(options.outputs, is_node_output)) grown.at_nodes = dress_nodes(fields, look);
    return grown;
  }
  grown.coat = dressed(fields, look, grown.paint, report);
  if (patches) grown.patches = patch_texture(fields, look, texture_size(options));
  if (patches && wants_images(options)) {
    grown.coat = with_uv(std::move(grown.coat), *grown.patches);
    grown.textures = textures_of(*grown.patches);
  }
  if (layout) {
    progress("baking", 0);
    bake_surface(fields, look, *layout, file, grown, report);
  }
  return grown;
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
  for (const std::string& path : options.outputs)
    if (is_node_output(path)) check_node_output(path, file.nodes.get());
  if (cut && !is_volume(file.nodes.get()))
    throw Error(Fault::usage,
                "--cut and --isosurface show the inside of volumes, and the shape is none; take for example "
                "builtin:box?n=64x64x64 or a .vtu or .msh file");
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

void write_files(const GrowOptions& options, const Grown& grown, const ShapeFile& file, bool keep_shape,
                 const SaveOptions& form, const Progress& progress, GrowReport& report) {
  const auto save_as = [&](const std::string& path) -> Saving {
    if (grown.image || (grown.patches && is_node_output(path))) {
      write_png(grown.image ? *grown.image : *grown.patches->image, path);
      return {{path}, "", {}};
    }
    if (grown.textures && options.bake) return save_with_textures(grown, path, form);
    if (is_node_output(path))
      return {{path}, save_nodes(*grown.nodes, grown.at_nodes ? *grown.at_nodes : grown.coat, path), {}};
    if (!keep_shape || grown.shape->triangles.empty()) return save_surface(grown.coat, path, form);
    return save_mesh(kept_shape(form_of_shape(file, *grown.shape), grown.coat, grown.paint), path, form);
  };
  write_outputs(options.outputs, save_as, progress, report);
  if (!options.patch_images.empty())
    for (const std::string& path : save_patches(*grown.patches, options.patch_images)) report.file(path);
  if (options.baked_maps.empty()) return;
  progress("writing " + options.baked_maps + "-color.png and the others", 0);
  for (const MapFile& map : save_maps(*grown.textures, options.baked_maps)) report.file(map.path, map.about);
}

void write_pictures(const GrowOptions& options, const Recipe& recipe, const Grown& grown, const ShapeFile& file,
                    const PictureOptions& picture, const Progress& progress, GrowReport& report) {
  write_picture(options.picture, progress, report, [&](const Progress& p) {
    const Grid* grid = as<Grid>(file.nodes);
    if (grown.image) return picture_of_nodes(*grid, *grown.image, options.preview, options.picture_size);
    if (grid && grid->dimension() < 3 && is_flat(*grid))
      return picture_of_nodes(*grid, grown.coat, options.preview, options.picture_size);
    return render(has_corner_normals(grown.coat) ? split_corners(grown.coat) : grown.coat, picture, p);
  });
  write_picture(options.panels, progress, report,
                [&](const Progress& p) { return four_panels(recipe, *grown.shape, grown.coat, picture, p); });
}

void grow(const GrowOptions& options) {
  const Recipe recipe = make_recipe(options);
  const Plan planned = plan(recipe);
  check_outputs(options, recipe.shape);
  if (!options.panels.empty() && !recipe.motion.fair)
    throw Error(Fault::usage, "--panels shows what --fair does; give it too");
  check_inputs(options, recipe);
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
  Carving carving = carving_of(options, planned, up);
  check_kind(options, recipe.look, file, carving);
  const std::optional<UvLayout> layout = layout_of(options, file, report);
  if (!recipe.look.keep_shape && !layout) file.source.reset();

  const Grown grown =
      grown_coat(options, planned, recipe.look, file, std::move(images), std::move(carving), layout, progress, report);
  write_files(options, grown, file, recipe.look.keep_shape, {object_name(file, recipe.shape), up}, progress, report);
  write_pictures(options, recipe, grown, file, picture_of(options, *planned.quality, up), progress, report);
  if (options.profile) report.profile(profile);
  report.end(total.seconds());
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
