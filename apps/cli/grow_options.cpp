#include "grow_options.h"

#include <filesystem>
#include <utility>

#include "base/suggest.h"
#include "catalog/models.h"
#include "catalog/plan.h"
#include "catalog/quality.h"
#include "catalog/shapes.h"
#include "catalog/size.h"
#include "input_unit.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/grid_file.h"
#include "io/png_writer.h"
#include "io/read_shape.h"
#include "io/write_mesh.h"
#include "look/ramp.h"
#include "node_outputs.h"
#include "outputs.h"
#include "panels.h"
#include "pelage/analyse.h"
#include "pelage/fair.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "picture_files.h"
#include "recipe/document.h"
#include "settings.h"
#include "shape/builtin_grids.h"
#include "shape/generators.h"
#include "texture_outputs.h"
#include "time/stepper.h"
#include "usage.h"
#include "video.h"

namespace pelage {

namespace {

constexpr std::int64_t most_steps = 1'000'000'000'000;
constexpr int largest_picture = 32768;
constexpr int most_tiles = 16;
/// Of --bake: whole numbers in that range; larger ones are told what they would need.
CLI::Validator texture_size_option() {
  const CLI::Validator whole = whole_number(smallest_texture, std::numeric_limits<std::int32_t>::max());
  return CLI::Validator(
      [whole](std::string& text) {
        std::string fault = whole(text);
        if (!fault.empty()) return fault;
        const double side = std::stod(text), gigabytes = bytes_of_a_texel * side * side / 1e9;
        if (side <= largest_texture) return fault;
        return "images of " + text + " x " + text + " texels need " + std::to_string(std::llround(gigabytes)) +
               " GB of memory; at most " + std::to_string(largest_texture) + " texels along a side";
      },
      "");
}

std::string choices(const std::vector<std::string>& names) { return ": " + join_names(names); }

std::vector<std::string> stepper_names() {
  std::vector<std::string> names;
  for (const StepperKind* kind : stepper_kinds()) names.emplace_back(kind->name);
  return names;
}

/// "jacobi-cg (conjugate gradients, preconditioned by the diagonal), cg (...) ...".
std::string solver_choices() {
  std::vector<std::string> names;
  for (const SolverKind* s : solver_kinds())
    names.push_back(std::string(s->name) + " (" + std::string(s->summary) + ")");
  return choices(names);
}

/// "loop (smooth, default) or linear (flat, faster)".
std::string method_choices() {
  std::string text;
  for (const Method* m : methods())
    text += (text.empty() ? "" : " or ") + std::string(m->name) + " (" + std::string(m->summary) + ")";
  return text;
}

std::string quality_choices() {
  std::string text;
  for (const Quality& q : qualities())
    text += (text.empty() ? "" : ", ") + std::string(q.name) + " (" + std::string(q.summary) + ")";
  return text;
}

std::string channel_choices() {
  std::string text;
  for (const ChannelKind& kind : channel_kinds)
    text += (text.empty() ? ": " : ", ") + std::string(kind.name) + " (" + std::string(kind.meaning) + ")";
  return text;
}

void add_pattern_options(CLI::App& app, GrowOptions& o) {
  const std::string group = "Pattern";
  app.add_option("--model", o.model, "MODEL, MODEL:VARIANT or a .toml file (default: turing); see pelage models")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--recipe", o.recipe, "A built-in recipe or a .toml file; the other options override its values")
      ->type_name("NAME|FILE")
      ->group(group);
  add_settings_option(app, o.settings)
      ->description(
          "Parameter of the model, or with STAGE. before it of a stage of a recipe; STAGE.size=LENGTH its size")
      ->type_name("[STAGE.]PARAM=VALUE")
      ->group(group);
  app.add_option(
         "--param-map", o.maps,
         "Parameter, or size, that differs from place to place: a formula of x, y, z, bx, nx, k1, "
         "attribute(NAME), ..., or attribute:NAME for a vertex attribute of the shape; a size is a factor on --size")
      ->type_name("[STAGE.]PARAM=FORMULA")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--texture", o.textures,
                 "PNG or JPEG image that formulas read through the shape's uv: its luminance as attribute(NAME), red, "
                 "green and blue as attribute(NAME_1), _2 and _3")
      ->type_name("NAME=FILE")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--size", o.size,
                 "Spacing of the pattern: a fraction of the shape's diagonal (default: 0.04) or a length: 4mm, 2cm, "
                 "0.1m, 3in, 1ft, or 1.5u in units of the file")
      ->type_name("LENGTH")
      ->group(group);
  add_input_unit_option(app, o.input_unit)->group(group);
  app.add_option(
         "--unit", o.unit,
         "Instead of --size, what one length unit of the model becomes: the model's own parameters then set the "
         "spacing")
      ->type_name("LENGTH")
      ->group(group);
  app.add_option("--seed", o.seed, "Number of the random pattern (default: 1)")
      ->type_name("N")
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()))
      ->group(group);
  app.add_flag("--interpolate", o.interpolate, "Let the smooth surface pass through the vertices of the shape")
      ->group(group);
  app.add_option("--crease", o.crease,
                 "Keep edges sharp where the shape bends by more than so many degrees: 40 for most machine parts")
      ->type_name("DEGREES")
      ->check(positive_number())
      ->group(group);
}

void add_time_options(CLI::App& app, GrowOptions& o) {
  const std::string group = "Computation";
  app.add_option("--quality", o.quality, "How accurate the coat is: " + quality_choices())
      ->type_name("NAME")
      ->group(group);
  app.add_option("--method", o.method, "Finite elements: " + method_choices())->type_name("NAME")->group(group);
  app.add_flag("--solid", o.solid, "Fill the shape, which is closed, with tetrahedra, and grow in its volume")
      ->excludes("--method")
      ->group(group);
  app.add_option("--cells", o.cells, "Grow on so many points scattered over the shape (method cells)")
      ->type_name("N")
      ->check(whole_number(1, std::numeric_limits<std::int64_t>::max()))
      ->group(group);
  app.add_option("--stepper", o.stepper,
                 "Time stepper (default: what suits the method and the model)" + choices(stepper_names()))
      ->type_name("NAME")
      ->group(group);
  app.add_option("--solver", o.solver, "Solver of the linear systems of implicit steps, to compare" + solver_choices())
      ->type_name("NAME")
      ->group(group);
  app.add_option("--refresh", o.refresh,
                 "Stepper semi-implicit: make its matrices anew every so many steps (default: 1), to compare")
      ->type_name("N")
      ->check(whole_number(1, most_steps))
      ->group(group);
  app.add_option("--step", o.step, "Fixed time step, model time (default: chosen as the pattern allows)")
      ->type_name("T")
      ->check(positive_number())
      ->group(group);
  app.add_option("--until", o.until, "Stop at this model time (default: the model's suggestion)")
      ->type_name("T")
      ->check(positive_number())
      ->group(group);
  app.add_option("--steps", o.steps, "Stop after so many steps")
      ->type_name("N")
      ->check(whole_number(0, most_steps))
      ->group(group);
  app.add_option("--stationary", o.stationary,
                 "Stop when the pattern changes by less than this fraction per unit of model time; 0: never (default: "
                 "the model's suggestion)")
      ->type_name("X")
      ->check(number_at_least_zero())
      ->group(group);
  app.add_flag("--nested", o.nested,
               "Begin on coarser grids of every second node, for even grids: patterns without jumps finish sooner")
      ->group(group);
  app.add_option("--threads", o.threads, "Threads to use (default: all cores); the result does not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads))
      ->group(group);
  app.add_option("--checkpoint", o.checkpoint,
                 "Keep the state here: now and then, at the end of stages and of the growth, and on Ctrl-C; "
                 "pelage resume FILE goes on (default: beside the first output where the growth takes longer than the "
                 "time between two)")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--every-minutes", o.every_minutes, "Time between two checkpoints (default: 5)")
      ->type_name("X")
      ->check(positive_number())
      ->group(group);
  app.add_option("--resume", o.resume, "Go on from such a state; shape and options must be the same")
      ->type_name("FILE")
      ->group(group);
}

void add_motion_options(CLI::App& app, GrowOptions& o) {
  const std::string group = "Moving surface";
  app.add_flag("--fair{guided}", o.fair,
               "Take the noise off the shape while the pattern grows; --fair=paper for another method" +
                   choices(fair_methods()))
      ->group(group);
  app.add_option("--growth", o.growth, "Rate at which all lengths of the surface grow, per model time (default: 0)")
      ->type_name("X")
      ->group(group);
  app.add_option("--motion", o.motion,
                 "What rides along with the surface: texture, the values (default), or physical, the amounts, which "
                 "are diluted where the area grows")
      ->type_name("MODE")
      ->group(group);
  app.add_option("--every", o.every, "Move the surface every so many time steps (default: 10)")
      ->type_name("N")
      ->check(whole_number(1, most_steps))
      ->group(group);
}

void add_look_options(CLI::App& app, GrowOptions& o) {
  const std::string group = "Colours";
  app.add_option("--species", o.species, "Which species is shown (default: the model's last)")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--ramp", o.ramp, "Colours (default: those of the model)" + choices(ramp_names()))
      ->type_name("NAME")
      ->group(group);
  app.add_flag("--invert", o.invert, "Exchange the ends of the ramp")->group(group);
  app.add_option("--material", o.channels,
                 "What the coat is like beside its colour, a formula as in layers of recipes" + channel_choices())
      ->type_name("CHANNEL=FORMULA")
      ->allow_extra_args(false)
      ->group(group);
  app.add_flag("--displace", o.displace,
               "Move the vertices by the height that --material or the recipe gives, instead of "
               "noting it beside them")
      ->group(group);
  app.add_flag("--keep-shape", o.keep_shape,
               "Give back the shape as it is, its own vertices and faces in their order with all that the file says of "
               "them, coloured at the vertices, instead of the smooth surface")
      ->group(group);
  app.add_flag("--flat", o.flat,
               "Colour the shape's flat triangles, split as --detail says, instead of the smooth surface")
      ->group(group);
  app.add_option("--detail", o.detail, "Split every triangle into four so often (default: as the colours need)")
      ->type_name("N")
      ->check(whole_number(0, most_detail))
      ->group(group);
  app.add_option(
         "--triangles", o.triangles,
         "At most so many triangles: more where shape and colour change, fewer elsewhere; each vertex is one of "
         "the finer coat")
      ->type_name("N")
      ->check(whole_number(4, 30'000'000))
      ->group(group)
      ->excludes("--keep-shape");
}

void add_file_options(CLI::App& app, GrowOptions& o, const std::string& group) {
  app.add_option("-o,--output", o.outputs,
                 "Files for the coated mesh; the extension is the format" + choices(mesh_extensions()) +
                     "; of grids and volumes also" + choices(node_output_extensions()) +
                     "; of patches also .png, all of them in one image")
      ->type_name("FILE[,FILE]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(group);
  app.add_flag(
         "--compress", o.compress,
         "Make GLB files small, to about a fifth: quantised and packed by meshoptimizer, which three.js, Babylon.js "
         "and Godot read, and Blender does not")
      ->group(group);
  app.add_flag(
         "--no-fields", o.no_fields,
         "Leave the concentrations of the species out of these files; colours and the shape's own attributes stay")
      ->group(group);
  app.add_option(
         "--bake", o.bake,
         "Of surfaces and patches: the coat as images of so many texels along a side, on the uv or an atlas, instead "
         "of "
         "colours at vertices, in GLB or beside OBJ, on the shape as it is; also the size of --maps, of .png and "
         "--patch-images (default: 2048)")
      ->type_name("N")
      ->check(texture_size_option())
      ->group(group);
  app.add_option(
         "--maps", o.baked_maps,
         "These images as files, PREFIX-color.png, PREFIX-height.png and .exr, PREFIX-normal.png where the look "
         "has a height; of UDIM tiles PREFIX-color.1001.png and so on")
      ->type_name("PREFIX")
      ->group(group);
  app.add_option("--onto", o.onto,
                 "With --bake or --maps: make these images for another mesh of the same shape, a coarser one for "
                 "example, by the nearest places of the coat; -o of --bake writes that mesh")
      ->type_name("MESH")
      ->group(group);
  app.add_flag("--mips", o.mips,
               "Beside --maps of a surface: PREFIX-color.ktx2, the colours with all their mip levels, which are "
               "blurred on the "
               "surface, so that nothing bleeds across seams of the uv")
      ->group(group);
  app.add_option("--patch-images", o.patch_images, "Of patches: folder for an image of each, PATCH.png")
      ->type_name("FOLDER")
      ->group(group);
  app.add_option(
         "--height-map", o.height_map,
         "Of a sheet: file for its height, or else the shown species, as a relief: .png of 16-bit grey, the lowest "
         "value black and the highest white")
      ->type_name("FILE")
      ->group(group);
}

void add_inside_options(CLI::App& app, GrowOptions& o, const std::string& group) {
  app.add_option(
         "--cut", o.cuts,
         "Of a volume: cut away where that holds, \"x<0\" or \"x>0 and y+z>0.5\", in pictures and meshes; \"x=0\": the "
         "side that pictures look from. May be given several times")
      ->type_name("CONDITION")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option(
         "--isosurface", o.isosurface,
         "Of a volume: show the solid where a species is above a level, or with SPECIES<LEVEL below it (default: "
         "halfway between its lowest and highest value); closed, for printing")
      ->type_name("SPECIES[=LEVEL]")
      ->group(group);
}

void add_picture_options(CLI::App& app, GrowOptions& o, const std::string& group) {
  app.add_option("--picture", o.picture,
                 "File for a picture: .png, or .exr in linear light; of a flat grid its nodes as pixels. Noise below 4 "
                 "steps of 255, docs/pictures.md")
      ->type_name("FILE")
      ->group(group);
  app.add_option_function<std::string>(
         "--preview",
         [&o](const std::string& text) {
           const auto counts = parse_counts(text, 2);
           if (!counts || (*counts)[0] < 1 || (*counts)[1] < 1 || (*counts)[0] > most_tiles ||
               (*counts)[1] > most_tiles)
             throw CLI::ValidationError("--preview", "expected tiles across and down, 1 to 16 each, for example 3x3");
           o.preview = {(*counts)[0], (*counts)[1]};
         },
         "Show a flat grid so many times across and down in its picture, as a floor of tiles: 3x3")
      ->type_name("NxM")
      ->group(group);
  app.add_option("--plot", o.plot,
                 "Of a line: file for a picture of the pattern in the course of time, downwards: .png")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--panels", o.panels,
                 "With --fair: file for four pictures side by side, .png: the noisy shape, the faired one, the pattern "
                 "on the noisy shape, and the coat")
      ->type_name("FILE")
      ->group(group);
  CLI::Option* frames =
      app.add_option("--frames", o.frames,
                     "Show the growth: so many frames at even distances in time. --picture walk.png becomes "
                     "walk.0001.png and so on, .mp4 and .webm a video (by ffmpeg), -o coat.vtp the files coat.0001.vtp "
                     "... with coat.pvd, .glb one file whose colours move")
          ->type_name("N")
          ->check(whole_number(2, 100'000))
          ->group(group);
  app.add_flag("--loop", o.loop, "These show the last period, so that they can be repeated, of models that have one")
      ->needs(frames)
      ->group(group);
  app.add_option("--from-frame", o.from_frame, "Go on with the frame of that number; those before it are there")
      ->type_name("N")
      ->check(whole_number(1, 100'000))
      ->needs(frames)
      ->group(group);
  app.add_option("--picture-size", o.picture_size, "Width and height of the picture, pixels (default: 1024)")
      ->type_name("N")
      ->check(whole_number(1, largest_picture))
      ->group(group);
  add_view_options(app, o.view, group);
  add_turntable_option(app, o.view, group);
}

void add_output_options(CLI::App& app, GrowOptions& o) {
  const std::string group = "Output";
  add_file_options(app, o, group);
  add_line_options(app, o.lines, group);
  add_inside_options(app, o, group);
  add_print_options(app, o.print, group);
  add_picture_options(app, o, group);
  app.add_flag("--profile", o.profile, "Print where the time went")->group(group);
  app.add_flag("--json", o.json, "Print what was done as JSON")->group(group);
  app.add_flag("-q,--quiet", o.quiet, "Print warnings and errors only")->group(group);
}

bool is_known(const std::string& name, const std::vector<std::string>& names) {
  return std::ranges::count(names, name) > 0;
}

/// "model" or "recipe" where that was given in the place of a shape; else empty.
std::string other_than_shape(const std::string& shape) {
  if (shape.ends_with(".toml")) {
    const Value document = read_document(shape);
    if (document.find("stage")) return "recipe";
    return document.find("species") ? "model" : "";
  }
  std::error_code ignored;
  if (std::filesystem::exists(shape, ignored)) return "";
  if (is_known(shape, model_names())) return "model";
  return is_known(shape, recipe_names()) ? "recipe" : "";
}

void refuse_other_than_shape(const std::string& shape) {
  const std::string kind = other_than_shape(shape);
  if (kind.empty()) return;
  throw Error(Fault::usage, shape + " is a " + kind + ", no shape to grow on; write pelage grow SHAPE --" + kind + " " +
                                shape + ", where SHAPE is a file or for example builtin:animal");
}

}  // namespace

void add_options(CLI::App& app, GrowOptions& options) {
  app.add_option("SHAPE", options.shape,
                 "File to grow on" + choices(readable_extensions()) + "; or builtin:NAME?n=VERTICES" +
                     choices(builtin_shape_names()) + "; or a grid, builtin:NAME?n=NODES or n=NODESxNODES" +
                     choices(builtin_grid_names()) + ", or a file of one" + choices(readable_grid_extensions()) +
                     ". May be left out when the recipe names one")
      ->type_name("");
  add_pattern_options(app, options);
  add_time_options(app, options);
  add_motion_options(app, options);
  add_look_options(app, options);
  add_output_options(app, options);
}

Recipe make_recipe(const GrowOptions& options) {
  refuse_other_than_shape(options.shape);
  Recipe recipe;
  if (options.recipe) recipe = load_recipe(*options.recipe);
  if (!options.shape.empty()) recipe.shape = options.shape;
  if (recipe.shape.empty())
    throw Error(Fault::usage, "no shape to grow on; name a file or a built-in one, for example builtin:animal");
  recipe = with_changes(std::move(recipe), options);
  recipe.look = shown_look(recipe);
  return recipe;
}

void check_inputs(const GrowOptions& options, const Recipe& recipe) {
  for (const TextureFile& texture : recipe.textures) require_file(texture.path);
  check_shape_name(recipe.shape);
  if (!options.onto.empty()) check_shape_name(options.onto);
  if (options.nested && !names_grid(recipe.shape))
    throw Error(Fault::usage, "--nested begins on coarser grids, and the shape is no grid; leave it out");
  if (!options.resume.empty()) require_file(options.resume);
}

void require_outputs(const GrowOptions& options) {
  if (options.outputs.empty() && options.picture.empty() && options.panels.empty() && options.plot.empty() &&
      options.height_map.empty() && options.patch_images.empty() && options.baked_maps.empty() &&
      options.lines.files.empty())
    throw Error(Fault::usage, "nothing to write; give -o FILE, --picture FILE or both");
}

namespace {

/// Of images on meshes, what can be known before the shape is.
void check_images(const GrowOptions& options, const std::string& shape) {
  if (!options.patch_images.empty() && !names_atlas(shape))
    throw Error(Fault::usage, "--patch-images is for patches, an image for each of them; take --bake");
  if (options.mips && options.baked_maps.empty())
    throw Error(Fault::usage,
                "--mips goes with --maps PREFIX, whose colours it writes with their mip levels; give it too");
  if (!options.onto.empty() && !wants_images(options))
    throw Error(Fault::usage, "--onto is for images: give --bake N, or --maps PREFIX, too");
  if (!wants_images(options)) return;
  if (!options.onto.empty() && (names_grid(shape) || names_atlas(shape) || options.solid))
    throw Error(Fault::usage, "--onto is for coats of surfaces, and the shape is none or grows in its volume");
  if (!options.onto.empty() && (names_grid(options.onto) || names_atlas(options.onto)))
    throw Error(Fault::usage, "--onto " + options.onto + ": expected a mesh");
  if (names_grid(shape) && !names_atlas(shape))
    throw Error(Fault::usage, "--bake and --maps are for surfaces with uv and for patches; of a grid write a .png");
  if (options.flat || options.detail.value_or(0) > 0)
    throw Error(Fault::usage, "--bake and --maps are for the shape as it is: leave --flat and --detail out");
  if (!options.baked_maps.empty()) check_maps(options.baked_maps);
  for (const std::string& output : options.outputs)
    if (options.bake && !is_node_output(output)) check_textured_path(output);
}

}  // namespace

void check_outputs(const GrowOptions& options, const std::string& shape) {
  if (options.compress &&
      std::ranges::none_of(options.outputs, [](const std::string& o) { return lower_extension(o) == ".glb"; }))
    throw Error(Fault::usage, "--compress is for GLB files, and none is asked for");
  if (options.triangles && (options.bake || names_grid(shape) || names_atlas(shape)))
    throw Error(Fault::usage,
                options.bake
                    ? "--triangles is for colours at vertices; with --bake the coat is an image on the shape as it is"
                    : "--triangles is for surfaces; the nodes of this shape stay where they are");
  for (const std::string& output : options.outputs) {
    if (is_node_output(output))
      expect_output(output);
    else
      check_mesh_path(output);
  }
  if (!options.picture.empty()) {
    if (is_video(options.picture) && !options.frames && !options.view.turntable)
      throw Error(
          Fault::usage,
          options.picture + ": a video shows the growth or goes around; say of how many --frames or --turntable");
    if (!is_video(options.picture) || options.view.turntable)
      check_picture_files(options.picture, options.view, options.picture_size);
  }
  if (options.view.turntable && (options.frames || options.picture.empty()))
    throw Error(Fault::usage,
                "--turntable goes around the finished coat in its --picture; give that, without --frames");
  if (!options.plot.empty()) check_picture_path(options.plot);
  check_images(options, shape);
  if (!options.height_map.empty()) {
    check_picture_path(options.height_map);
    if (!names_grid(shape)) throw Error(Fault::usage, "--height-map is for sheets of grids, a pixel for each node");
  }
  if (options.preview != std::array{1, 1} && (!names_grid(shape) || options.picture.empty()))
    throw Error(Fault::usage,
                "--preview shows a tile several times in its --picture; give that, and a grid for the shape");
  if (!options.panels.empty()) {
    check_picture_path(options.panels);
    const auto [width, height] = size_of_panels(options.picture_size);
    check_picture_size(width, height, options.panels);
  }
  if (!options.checkpoint.empty()) expect_output(options.checkpoint);
  if (options.resume.empty()) return;
  std::vector<std::string> files = options.outputs;
  files.insert(files.end(), {options.picture, options.panels, options.plot, options.height_map});
  for (const std::string& file : files)
    if (!file.empty() && true_path(file) == true_path(options.resume))
      throw Error(Fault::usage, "the output " + file + " is the checkpoint itself; give it another name");
}

}  // namespace pelage
