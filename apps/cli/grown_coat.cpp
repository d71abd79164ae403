#include "grown_coat.h"

#include <algorithm>

#include "catalog/textured_coat.h"
#include "grow_run.h"
#include "input_unit.h"
#include "io/file_bytes.h"
#include "look/coat_sampler.h"
#include "look/cut_tessellation.h"
#include "look/dress.h"
#include "look/kept_shape.h"
#include "look/mip_levels.h"
#include "look/onto_mesh.h"
#include "look/sheet_image.h"
#include "look/solid_tessellation.h"
#include "look/tessellation.h"
#include "node_outputs.h"
#include "shape/normals.h"
#include "shape/simplify.h"
#include "shape/vectors.h"
#include "text.h"

namespace pelage {

namespace {

int texture_size(const GrowOptions& options) { return options.bake.value_or(default_texture); }

SourceShape form_of_shape(const ShapeFile& file, const TriangleMesh& shape) {
  return file.source ? *file.source : own_form(shape);
}

/// Of patches: whether any output shows images of them; checks that these have room.
bool wants_patches(const GrowOptions& options, const ShapeFile& file) {
  const Atlas* atlas = as<Atlas>(file.nodes);
  const bool wanted = wants_images(options) || !options.patch_images.empty() ||
                      std::ranges::any_of(options.outputs, [](const std::string& o) { return is_node_output(o); });
  if (!atlas || !wanted) return false;
  lay_out(*atlas, texture_size(options));
  return true;
}

/// The mesh that shows the images, and its triangles.
struct ImagedMesh {
  PolygonMesh polygons;
  const TriangleMesh& triangles;
  const SourceShape* source;
};

/// The file's own mesh, or that of --onto with normals, from which normal maps count.
ImagedMesh imaged_mesh(const CoatFields& fields, const CoatRequest& request, const Grown& grown) {
  const Cells* cells = as<Cells>(fields.nodes);
  const TriangleMesh& shape = cells ? *cells->on : *grown.shape;
  if (!request.onto) {
    Look as_given = request.look;
    as_given.keep_shape = true;
    return {kept_shape(form_of_shape(request.file, shape), dress(fields, as_given), grown.paint), shape,
            request.file.source.get()};
  }
  const TriangleMesh& mesh = request.onto->mesh;
  TriangleMesh normals{mesh.points, mesh.triangles, {}, {}, mesh.metres_per_unit};
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& n : vertex_normals(mesh)) normal.values.insert(normal.values.end(), n.begin(), n.end());
  normals.set(std::move(normal));
  return {kept_shape(form_of_shape(*request.onto, mesh), normals, grown.paint), mesh, request.onto->source.get()};
}

/// Farther from the coat than this share of its diagonal a mesh shows what cannot be meant.
constexpr double far_share = 0.02;

std::string line_of(const FarTriangles& far, const ImagedMesh& mesh, double distance) {
  return counted(far.count, "triangle") + " of --onto, " + (far.count > 1 ? "the first one of" : "of") + " face " +
         std::to_string(face_in_file(far.first, mesh.triangles, mesh.source)) + ", " +
         (far.count > 1 ? "lie" : "lies") + " farther than " + brief(distance) + " (" + brief(far_share) +
         " of the diagonal) from the coat, up to " + brief(far.furthest) + ": the nearest place is shown all the same";
}

/// The coat on the surface that it has grown on, as images on a mesh.
void bake_surface(const CoatFields& fields, const CoatRequest& request, Grown& grown, GrowReport& report) {
  const UvLayout& layout = *request.layout;
  ImagedMesh mesh = imaged_mesh(fields, request, grown);
  const TriangleMesh& shape = mesh.triangles;
  if (const std::string line = too_coarse(shape, layout.size(), fields.wavelength); !line.empty()) report.warning(line);
  std::optional<ShadingFrames> frames;
  if (request.onto || grown.paint.channels.contains(Channel::height)) frames.emplace(shaded_mesh(mesh.polygons, shape));
  Look smooth = request.look;
  smooth.keep_shape = false;
  const Tessellation t = tessellate(fields, tessellation_request(smooth, grown.paint));
  std::optional<OntoMesh> onto;
  if (request.onto) {
    onto.emplace(shape, t);
    const double distance = far_share * box_of(t.samples.position).diagonal();
    const FarTriangles far = onto->farther_than(distance);
    if (far.count > 0) report.warning(line_of(far, mesh, distance));
  }
  const CoatSampler sampler(fields, t, grown.paint, onto ? &*onto : nullptr);
  const Palette palette = make_palette(grown.paint, t.samples, fields.uniform);
  BakedCoat baked = bake(sampler, palette, layout, frames ? &*frames : nullptr);
  for (const std::string& line : lines_of({baked.hidden}, shape, mesh.source)) report.warning(line);
  grown.textures = textures_of(std::move(baked), layout);
  if (request.options.mips) grown.textures->levels = mip_levels(sampler, palette, shape, layout);
  grown.textured = std::move(mesh.polygons);
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

void write_coat_lines(const CoatFields& fields, const CoatRequest& request, GrowReport& report) {
  const LineOptions& options = request.options.lines;
  const LineFiles written =
      write_lines(options, fields, request.look, request.options.view.up.value_or(request.file.up));
  for (const std::string& text : written.warnings) report.warning(text);
  for (std::size_t i = 0; i < options.files.size(); ++i) report.file(options.files[i], written.about[i]);
}

TriangleMesh dressed(const CoatFields& fields, const CoatRequest& request, const TriangleMesh& shape, Paint paint,
                     GrowReport& report) {
  const PrintOptions& print = request.options.print;
  add_holes(paint, print);
  Tessellation t = print.any() ? tessellate(fields, tessellation_request(request.look, paint))
                               : tessellate_for(fields, request.look, paint);
  for (const std::string& line : clamped_channels(t.samples, paint)) report.warning(line);
  const ShapeScale scale = fields.nodes ? scale_of(*fields.nodes, shape) : scale_of(shape);
  PrintedCoat printed = printed_coat(std::move(t), paint, fields.uniform, print, scale);
  for (const std::string& line : printed.warnings) report.warning(line);
  return std::move(printed.coat);
}

/// What printers need to know of its surface.
void report_print(const TriangleMesh& coat, const CoatRequest& request, GrowReport& report) {
  if (!request.options.print.any() && !request.look.displace) return;
  if (const std::string line = line_about_meetings(coat); !line.empty()) report.warning(line);
  if (request.options.print.thickness) report.solid(about_solid(coat));
}

/// Whether a coat on a sheet is asked for as nothing but pixels.
bool only_images(const GrowOptions& options, const Look& look) {
  return options.panels.empty() && !look.keep_shape &&
         std::ranges::all_of(options.outputs, [](const auto& path) { return lower_extension(path) == ".png"; });
}

void carve_body(const CoatFields& fields, const Look& look, const GrowOptions& options, Carving carving, Grown& grown,
                GrowReport& report) {
  if (const std::string other = fit_level(carving, fields); !other.empty()) report.warning(other);
  for (const std::string& line :
       clamped_channels(samples_at_nodes(fields, tessellation_request(look, grown.paint)), grown.paint))
    report.warning(line);
  grown.coat = dress_body(fields, look, carving);
  if (std::ranges::any_of(options.outputs, is_node_output)) grown.at_nodes = dress_nodes(fields, look);
}

/// To the number of triangles that is asked for, where that is fewer.
void reduce(TriangleMesh& coat, const GrowOptions& options, GrowReport& report) {
  if (!options.triangles || coat.triangles.empty()) return;
  const auto asked = static_cast<std::size_t>(*options.triangles), before = coat.triangles.size();
  if (before <= asked) return;
  coat = simplify(coat, asked);
  if (coat.triangles.size() > asked)
    report.warning("--triangles " + std::to_string(asked) + ": " + std::to_string(coat.triangles.size()) +
                   " are left; the kind of the surface, its seams and the borders of materials need them");
}

/// The boxes of two meshes of one shape are about the same.
void require_same_place(const std::string& path, const TriangleMesh& mesh, const TriangleMesh& shape) {
  const Box own = box_of(mesh.points), of_shape = box_of(shape.points);
  const double factor = own.diagonal() / of_shape.diagonal(),
               apart = length(difference(own.middle(), of_shape.middle())) / of_shape.diagonal();
  constexpr double most_factor = 2, most_apart = 0.5;
  if (factor < most_factor && factor > 1 / most_factor && apart < most_apart) return;
  throw Error(Fault::input,
              "it is no mesh of the shape that the coat grows on: its diagonal is " + number(factor, 4) +
                  " times that of the shape, and its middle " + number(apart, 4) +
                  " diagonals away; is it in other units, or does another axis point upwards?",
              {path});
}

void add_patches(const CoatFields& fields, const Look& look, const GrowOptions& options, Grown& grown) {
  grown.patches = patch_texture(fields, look, texture_size(options));
  if (!wants_images(options)) return;
  grown.coat = with_uv(std::move(grown.coat), *grown.patches);
  grown.textures = textures_of(*grown.patches);
}

}  // namespace

std::optional<ShapeFile> read_onto(const GrowOptions& options, const Recipe& recipe, const ShapeFile& shape,
                                   const Progress& progress, GrowReport& report) {
  if (options.onto.empty()) return {};
  if ((shape.nodes && !as<Cells>(shape.nodes)) || shape.mesh.triangles.empty())
    throw Error(Fault::usage, "--onto is for coats of surfaces, and the shape is none or grows in its volume");
  if (recipe.motion.growth != 0)
    throw Error(Fault::usage, "--growth moves the coat away from the mesh of --onto: leave one of them out");
  progress("reading " + options.onto, 0);
  ShapeFile onto = read_surface(options.onto, options.input_unit);
  if (onto.nodes || onto.mesh.triangles.empty())
    throw Error(Fault::usage, "--onto " + options.onto + ": expected a mesh");
  report.onto(options.onto, onto);
  require_same_place(options.onto, onto.mesh, shape.mesh);
  return onto;
}

void make_atlas(const GrowOptions& options, const Recipe& recipe, ShapeFile& file, const Progress& progress,
                GrowReport& report) {
  if (!wants_images(options) || (file.nodes && !as<Cells>(file.nodes)) || file.mesh.triangles.empty() ||
      has_uv(file.mesh) || (!recipe.textures.empty() && options.onto.empty()))
    return;
  const int size = std::max(texture_size(options), smallest_texture);
  AtlasShape atlas = interruptible("before the growth began; nothing was written",
                                   [&] { return with_atlas(std::move(file), size, progress); });
  file = std::move(atlas.file);
  report.warning("the shape has no uv: it gets an atlas of " + counted(atlas.charts, "chart") +
                 ", as pelage unwrap makes it" + (options.outputs.empty() ? "; only the mesh of -o FILE has it" : ""));
}

std::optional<UvLayout> layout_of(const GrowOptions& options, const ShapeFile& file, GrowReport& report) {
  if (options.mips && as<Atlas>(file.nodes))
    throw Error(Fault::usage, "--mips is for uv of surfaces, where charts have seams; leave it out for patches");
  if (!wants_images(options) || as<Atlas>(file.nodes)) return {};
  if (file.nodes && !as<Cells>(file.nodes))
    throw Error(Fault::usage, "--bake and --maps are for surfaces with uv and for patches, and the shape is neither");
  std::optional<UvLayout> layout = uv_layout(file.mesh, texture_size(options));
  for (const std::string& line : lines_of(layout->notes(), file.mesh, file.source.get())) report.warning(line);
  return layout;
}

void check_coat(const CoatRequest& request) {
  wants_patches(request.options, request.file);
  if (!request.options.height_map.empty()) require_sheet(request.file);
}

Grown grown_coat(const CoatFields& fields, const std::shared_ptr<const TriangleMesh>& shape, const CoatRequest& request,
                 const Progress& progress, GrowReport& report) {
  const auto& [options, look, file, layout, onto, carving] = request;
  Grown grown{{}, {}, {}, shape, resolve_paint(look, fields.species), fields.nodes, {}, {}, {}};
  progress("colouring", 0);
  if (!options.height_map.empty()) write_relief(*as<Grid>(file.nodes), fields, look, options.height_map, report);
  if (!options.lines.files.empty()) write_coat_lines(fields, request, report);
  if (only_images(options, look) && is_bare_sheet(fields)) {
    grown.image = sheet_image(fields, look);
    return grown;
  }
  if (is_volume(fields.nodes.get())) {
    carve_body(fields, look, options, carving, grown, report);
    reduce(grown.coat, options, report);
    return grown;
  }
  grown.coat = dressed(fields, request, *shape, grown.paint, report);
  reduce(grown.coat, options, report);
  report_print(grown.coat, request, report);
  if (wants_patches(options, file)) add_patches(fields, look, options, grown);
  if (layout) {
    progress("baking", 0);
    bake_surface(fields, request, grown, report);
  }
  return grown;
}

PolygonMesh coat_in_file(const Grown& grown, const ShapeFile& file) {
  return kept_shape(form_of_shape(file, *grown.shape), grown.coat, grown.paint);
}

}  // namespace pelage
