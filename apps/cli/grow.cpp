// pelage grow: a shape goes in, a coated mesh and a picture come out.

#include <algorithm>
#include <chrono>
#include <memory>

#include "base/parallel.h"
#include "catalog/bind.h"
#include "catalog/images.h"
#include "command.h"
#include "grid_outputs.h"
#include "grow_options.h"
#include "grow_report.h"
#include "input_unit.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/write_mesh.h"
#include "look/dress.h"
#include "panels.h"
#include "pelage/io.h"
#include "progress_bar.h"
#include "space_time.h"
#include "text.h"

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

/// `grid`: the coat on that of the shape, if it is one.
template <class Mesh>
void write_outputs(const GrowOptions& options, const Mesh& coat, const Grid* grid, const SaveOptions& form,
                   const Progress& progress, GrowReport& report) {
  for (const std::string& path : options.outputs) {
    progress("writing " + path, 0);
    const bool as_grid = is_grid_output(path);
    interruptible("before " + path + " was written", [&] {
      if (as_grid)
        save_grid(*grid, path);
      else
        save(coat, path, form);
    });
    report.file(path);
    if (as_grid) continue;
    for (const std::string& loss : losses(coat, extension_of(path))) report.warning(path + ": " + loss);
  }
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

PictureOptions picture_options(const GrowOptions& options, const Quality& quality, UpAxis up) {
  PictureOptions picture;
  picture.samples = quality.picture_samples;
  picture.width = picture.height = options.picture_size;
  picture.up = up;
  return picture;
}

GrowReport::Form form_of(const GrowOptions& options) {
  if (options.json) return GrowReport::Form::json;
  return options.quiet ? GrowReport::Form::nothing : GrowReport::Form::lines;
}

/// The coat when it has grown, and the shape as it was given. The run and its matrices are gone when pictures are
/// drawn.
struct Grown {
  TriangleMesh coat;
  std::shared_ptr<const TriangleMesh> shape;
  Paint paint;
};

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

Grown grown_coat(const GrowOptions& options, const Plan& planned, const Look& look, ShapeFile& file,
                 std::vector<Texture> images, const Progress& progress, GrowReport& report) {
  Run run = interruptible("before the growth began; nothing was written",
                          [&] { return Run(bind_plan(planned, file, std::move(images)), progress); });
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
  return {dress(fields, look), run.program().shape, resolve_paint(look, fields.species)};
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
  ShapeFile file = read_shape(recipe.shape, options.input_unit);
  report.shape(recipe.shape, file);
  if (!recipe.look.keep_shape) file.source.reset();

  const Grown grown = grown_coat(options, planned, recipe.look, file, std::move(images), progress, report);
  const UpAxis up = options.up.value_or(file.up);
  const SaveOptions form{object_name(file, recipe.shape), up};
  if (recipe.look.keep_shape)
    write_outputs(options, kept_shape(form_of_shape(file, *grown.shape), grown.coat, grown.paint), nullptr, form,
                  progress, report);
  else if (const Grid* nodes = as<Grid>(file.nodes)) {
    const Grid grid = on_grid(*nodes, grown.coat);
    write_outputs(options, surface_of(grid, grown.coat, grown.paint), &grid, form, progress, report);
  } else
    write_outputs(options, grown.coat, nullptr, form, progress, report);
  const PictureOptions picture = picture_options(options, *planned.quality, up);
  write_picture(options.picture, progress, report, [&](const Progress& p) {
    if (const Grid* grid = as<Grid>(file.nodes); grid && is_flat(*grid))
      return picture_of_nodes(*grid, grown.coat, options.preview, options.picture_size);
    return render(grown.coat, picture, p);
  });
  write_picture(options.panels, progress, report,
                [&](const Progress& p) { return four_panels(recipe, *grown.shape, grown.coat, picture, p); });
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
