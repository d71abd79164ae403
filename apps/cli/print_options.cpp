#include "print_options.h"

#include <algorithm>
#include <cmath>

#include "base/length_unit.h"
#include "base/number.h"
#include "look/dress.h"
#include "look/perforation.h"
#include "print/self_meeting.h"
#include "print/thicken.h"
#include "shape/describe.h"
#include "shape/normals.h"
#include "text.h"

namespace pelage {

namespace {

std::string how_many(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string percent_text(double part) { return number(std::round(1000 * part) / 10) + " %"; }

std::string length_text(double length, const std::optional<double>& metres_per_unit) {
  return metres_per_unit ? length_in_words(length * *metres_per_unit) : number(length) + " units";
}

bool closes(const std::vector<Triangle>& triangles, std::size_t vertices) {
  return describe({std::vector<Point>(vertices, Point{}), triangles, {}}, {}).closed;
}

TriangleMesh with_holes_said(const Tessellation& t, const Palette& palette, std::vector<std::string>& warnings) {
  Perforated left = with_holes(t, palette.paint);
  if (left.islands > 0)
    warnings.push_back(how_many(left.islands, "part", "parts") + " between the holes (" +
                       percent_text(left.island_area) + " of the rest) hung on nothing and " +
                       (left.islands == 1 ? "was" : "were") + " left out");
  return dress(std::move(left.tessellation), palette);
}

Wall wall_said(const TriangleMesh& coat, double thickness, WallSide side, std::vector<std::string>& warnings) {
  Wall wall = thickened(coat, thickness, side);
  if (wall.thinner > 0)
    warnings.push_back("the wall of " + length_text(thickness, coat.metres_per_unit) + " is thinner at " +
                       how_many(wall.thinner, "vertex", "vertices") + " of " + std::to_string(coat.points.size()) +
                       ", where it would meet itself: " + length_text(wall.thinnest, coat.metres_per_unit) +
                       " at the least");
  wall.mesh.set(corner_normals(wall.mesh.triangles, wall.mesh.points, wall.part));
  return wall;
}

bool has_sides(const NodeShape* nodes) {
  const auto* grid = nodes ? std::get_if<Grid>(nodes) : nullptr;
  return !nodes || std::holds_alternative<Atlas>(*nodes) || (grid && grid->dimension() == 2);
}

ChannelFormula holes_of(const PrintOptions& options, const std::vector<std::string>& species) {
  return condition_on_coat({*options.holes, {"--perforate " + *options.holes}}, species);
}

double wall_thickness(const PrintOptions& options, const ShapeScale& scale) {
  const Location where{"--thicken " + *options.thickness};
  const Given<Length> length{parse_length(*options.thickness, where), where};
  require_fraction("a wall of", length);
  return world_length(length, scale);
}

}  // namespace

void add_print_options(CLI::App& app, PrintOptions& options, const std::string& group) {
  app.add_option("--perforate", options.holes,
                 "Leave out of a surface where that holds: \"b < 0.4\", or other conditions of what formulas of layers "
                 "know; parts that then hang on nothing go, too")
      ->type_name("CONDITION")
      ->group(group);
  app.add_option(
         "--thicken", options.thickness,
         "Give a surface walls, so that it is a solid for printing: 1mm, or a fraction of the shape's diagonal; "
         "inwards, and half to either side of one with borders of its own")
      ->type_name("LENGTH")
      ->group(group);
}

void check_print(const PrintOptions& options, const Look& look, const ShapeFile& file, bool images,
                 const std::vector<std::string>& species) {
  if (!options.any()) return;
  const std::string what = options.holes ? "--perforate" : "--thicken";
  if (look.keep_shape)
    throw Error(Fault::usage, what + " makes other surfaces than the shape's: leave --keep-shape out");
  if (images) throw Error(Fault::usage, what + " makes other surfaces than the shape's: leave --bake and --maps out");
  if (!has_sides(file.nodes.get()))
    throw Error(Fault::usage, what + " is for surfaces; of volumes --isosurface gives what can be printed");
  const auto* atlas = file.nodes ? std::get_if<Atlas>(file.nodes.get()) : nullptr;
  if (atlas && atlas->one_sided && options.thickness)
    throw Error(Fault::usage, "--thicken needs the two sides of a surface, and this one turns over into itself");
  if (options.holes) holes_of(options, species);
  if (options.thickness) wall_thickness(options, scale_of(file));
}

void add_holes(Paint& paint, const PrintOptions& options) {
  if (options.holes) paint.holes = holes_of(options, paint.species);
}

PrintedCoat printed_coat(Tessellation t, const Paint& paint, const std::vector<char>& uniform,
                         const PrintOptions& options, const ShapeScale& scale) {
  const Palette palette = make_palette(paint, t.samples, uniform);
  PrintedCoat result;
  const bool closed = !options.thickness || closes(t.triangles, t.samples.size());
  result.coat = options.holes ? with_holes_said(t, palette, result.warnings) : dress(std::move(t), palette);
  if (options.thickness)
    result.coat = wall_said(result.coat, wall_thickness(options, scale), closed ? WallSide::inward : WallSide::both,
                            result.warnings)
                      .mesh;
  return result;
}

std::string line_about_meetings(const TriangleMesh& coat) {
  const std::vector<Meeting> meetings = self_meetings(coat.triangles, coat.points);
  if (meetings.empty()) return "";
  const Point p = middle_of(coat.triangles[static_cast<std::size_t>(meetings[0].first)], coat.points);
  return "the surface goes through itself at " + how_many(meetings.size(), "pair", "pairs") +
         " of triangles, first near (" + number(p[0]) + ", " + number(p[1]) + ", " + number(p[2]) + ")";
}

std::string about_solid(const TriangleMesh& solid) {
  const MeshReport report = describe(solid, {});
  std::string volume = number(report.volume) + " cubic units";
  if (solid.metres_per_unit) volume = number(report.volume * std::pow(100 * *solid.metres_per_unit, 3)) + " cm^3";
  return how_many(solid.triangles.size(), "triangle", "triangles") + ", " + (report.closed ? "closed" : "open") + ", " +
         how_many(report.components, "piece", "pieces") + ", " +
         how_many(static_cast<std::size_t>(report.genus), "handle", "handles") + ", " + volume;
}

}  // namespace pelage
