// pelage field: a direction field on a surface.

#include "pelage/field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <sstream>

#include "base/box.h"
#include "base/suggest.h"
#include "command.h"
#include "direction/guides.h"
#include "direction/hatching.h"
#include "input_unit.h"
#include "interrupt.h"
#include "outputs.h"
#include "pelage/io.h"
#include "pelage/render.h"
#include "picture_files.h"
#include "progress_bar.h"
#include "run/directions.h"
#include "run/program.h"
#include "text.h"
#include "usage.h"
#include "view_options.h"

namespace pelage {

namespace {

struct FieldCommand {
  std::string shape, axis, picture;
  std::vector<std::string> outputs, strokes;
  std::vector<Index> from, to;
  int n = 2;
  std::optional<double> smooth;
  std::optional<double> input_unit;  ///< metres
  bool curvature = false, across = false, json = false, quiet = false;
  double spacing = 0;
  ViewOptions view;
  int size = 1024;
};

/// "X,Y,Z".
Point parse_point(const std::string& option, const std::string& text) {
  Point p{};
  std::istringstream in(text);
  char comma = ',';
  for (std::size_t k = 0; k < 3; ++k)
    if ((k > 0 && (!(in >> comma) || comma != ',')) || !(in >> p[k]))
      throw Error(Fault::usage, option + " " + text + ": expected X,Y,Z, for example 0,0,1");
  if (in.peek() != std::istringstream::traits_type::eof())
    throw Error(Fault::usage, option + " " + text + ": there is more than X,Y,Z");
  return p;
}

/// "X,Y,Z X,Y,Z ...".
std::vector<Point> parse_stroke(const std::string& text) {
  std::vector<Point> stroke;
  std::istringstream in(text);
  for (std::string point; in >> point;) stroke.push_back(parse_point("--stroke", point));
  return stroke;
}

void require_one_guide(const FieldCommand& o) {
  const int kinds = !o.axis.empty() + o.curvature + (!o.from.empty() || !o.to.empty());
  if (kinds > 1) throw Error(Fault::usage, "give one of --axis, --curvature, and --from with --to");
  if (kinds == 0 && o.across) throw Error(Fault::usage, "--across needs --axis, --curvature, or --from with --to");
  if (kinds == 0 && o.smooth) throw Error(Fault::usage, "--smooth needs --axis, --curvature, or --from with --to");
}

FieldWish wish_of(const FieldCommand& o, double diagonal) {
  FieldWish wish;
  if (!o.axis.empty()) wish.axis = parse_point("--axis", o.axis);
  wish.curvature = o.curvature;
  wish.from = o.from;
  wish.to = o.to;
  wish.across = o.across;
  wish.smooth = o.smooth.value_or(default_field_smoothing) * diagonal;
  for (const std::string& text : o.strokes) wish.strokes.push_back(parse_stroke(text));
  return wish;
}

struct Counts {
  int positive = 0, negative = 0, sum = 0;
};

Counts count(const DirectionField& field) {
  Counts c;
  for (const int index : field.index) {
    c.positive += index > 0;
    c.negative += index < 0;
    c.sum += index;
  }
  return c;
}

/// The shape with the field instead of directions that it had.
TriangleMesh with_field(TriangleMesh mesh, const Connection& c, const DirectionField& field) {
  for (const std::string& name : direction_attributes(mesh))
    std::erase_if(mesh.attributes, [&](const Attribute& a) { return a.name == name; });
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& n : c.normal) normal.values.insert(normal.values.end(), n.begin(), n.end());
  mesh = with_directions(std::move(mesh), field.direction);
  if (!mesh.find("normal")) mesh.set(std::move(normal));
  return mesh;
}

void draw(const FieldCommand& o, const TriangleMesh& mesh, UpAxis up, const Connection& c, const DirectionField& field,
          const Progress& progress) {
  PictureScene scene(hatched(mesh, c, field, {o.spacing * box_of(mesh.points).diagonal()}));
  take_pictures(o.picture, o.view, picture_options(o.view, o.size, up, mesh),
                [&](const PictureOptions& picture) { return scene.render(picture, progress); });
}

void report(const FieldCommand& o, const ShapeFile& file, const std::vector<std::string>& warnings,
            const DirectionField& field) {
  const TriangleMesh& mesh = file.mesh;
  const Counts c = count(field);
  std::vector<std::string> files = o.outputs;
  if (!o.picture.empty()) files.push_back(first_picture(o.picture, o.view));
  if (o.json)
    return print_json({{"shape", o.shape},
                       {"n", o.n},
                       {"vertices", mesh.points.size()},
                       {"singularities", {{"positive", c.positive}, {"negative", c.negative}}},
                       {"index_sum", json_number(static_cast<double>(c.sum) / o.n)},
                       {"roughness", json_number(field.roughness)},
                       {"files", files},
                       {"findings", json_findings(file.findings)},
                       {"warnings", warnings}});
  if (o.quiet) return;
  print_findings(file.findings);
  std::printf("field     %d direction%s at each of %zu vertices\n", o.n, o.n == 1 ? "" : "s", mesh.points.size());
  std::printf("singular  %d triangles of positive index, %d of negative; sum of the indices %s\n", c.positive,
              c.negative, number(static_cast<double>(c.sum) / o.n).c_str());
  print_written(files);
}

void run_field(const FieldCommand& o) {
  for (const std::string& path : o.outputs) check_mesh_path(path);
  if (!o.picture.empty()) check_picture_files(o.picture, o.view, o.size);
  require_one_guide(o);
  catch_interrupts();
  ProgressBar bar(o.quiet || o.json ? ProgressBar::Style::none : ProgressBar::style_of_stderr());
  const ShapeFile file = read_surface(o.shape, o.input_unit);
  const TriangleMesh& mesh = file.mesh;
  const UpAxis up = o.view.up.value_or(file.up);
  const Connection c = make_connection(make_topology(mesh.points.size(), mesh.triangles), mesh.points);
  const double diagonal = box_of(mesh.points).diagonal();
  const DirectionField field = direction_field(c, o.n, find_guides(wish_of(o, diagonal), c, mesh.points, diagonal));
  std::vector<std::string> warnings;
  if (!o.outputs.empty()) {
    const std::vector<std::string> before = direction_attributes(mesh);
    warnings = save_all(with_field(mesh, c, field), o.outputs, {object_name(file, o.shape), up});
    if (!before.empty()) warn("the new field takes the place of " + join_names(before) + " of the shape", warnings);
  }
  if (!o.picture.empty()) draw(o, mesh, up, c, field, bar.progress());
  publish_outputs();
  bar.clear();
  report(o, file, warnings, field);
}

void add_guide_options(CLI::App* app, FieldCommand& o) {
  app->add_option("--axis", o.axis, "Follow the projection of this vector")->type_name("X,Y,Z");
  app->add_flag("--curvature", o.curvature, "Follow the larger principal curvature where there is one");
  app->add_option("--from", o.from, "Follow the gradient of the harmonic function that is 0 at these vertices")
      ->delimiter(',')
      ->type_name("VERTICES");
  app->add_option("--to", o.to, "... and 1 at these: from hip to foot, from snout to tail")
      ->delimiter(',')
      ->type_name("VERTICES");
  app->add_flag("--across", o.across, "Run across the axis, curvature or gradient instead of along");
  app->add_option("--smooth", o.smooth, "Length over which wishes are smoothed, diagonals (0.05)")
      ->check(positive_number())
      ->type_name("X");
  app->add_option("--stroke", o.strokes, "Follow this line in space exactly; may be given several times")
      ->type_name("\"X,Y,Z X,Y,Z ...\"");
}

void add_picture_options(CLI::App* app, FieldCommand& o) {
  app->add_option("--picture", o.picture, "Draw the field into a file: .png, or .exr in linear light")
      ->type_name("FILE");
  app->add_option("--picture-size", o.size, "Width and height of the picture in pixels (1024)")
      ->check(whole_number(1, 32768))
      ->type_name("N");
  app->add_option("--spacing", o.spacing, "Distance of the drawn strokes, diagonals (0.02)")
      ->check(positive_number())
      ->type_name("X");
  add_view_options(*app, o.view);
  add_turntable_option(*app, o.view);
}

}  // namespace

Command add_field(CLI::App& parent) {
  auto o = std::make_shared<FieldCommand>();
  CLI::App* app = parent.add_subcommand(
      "field",
      "Lay a direction field over a surface\n"
      "The smoothest one, or one that follows strokes, an axis, the curvature, or the way from one place to another. "
      "Anisotropic models follow the vertex attribute \"direction\" that it writes; without one they take the "
      "smoothest "
      "field of lines.");
  app->add_option("SHAPE", o->shape, "An OBJ, PLY, STL, OFF, glTF or GLB file, or builtin:NAME?n=VERTICES")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", o->outputs, "Files to write, with the attribute \"direction\": .ply, .vtp")
      ->delimiter(',')
      ->type_name("FILES");
  app->add_option("-n", o->n, "Directions per vertex: 1 vectors, 2 lines (default), 4 crosses")
      ->check(CLI::IsMember({1, 2, 4}))
      ->type_name("N");
  add_guide_options(app, *o);
  add_picture_options(app, *o);
  add_input_unit_option(*app, o->input_unit);
  app->add_flag("--json", o->json, "Print the result as JSON");
  app->add_flag("-q,--quiet", o->quiet, "Print nothing but errors");
  app->footer(
      "Examples:\n"
      "  pelage field cow.obj -o field.vtp --picture field.png\n"
      "  pelage field cow.obj --axis 0,0,1 --across -o cow.ply\n"
      "  pelage field horse.ply --from 812 --to 40,77 -n 1 --picture legs.png");
  return {app, [o] { run_field(*o); }};
}

}  // namespace pelage
