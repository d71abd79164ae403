#include "gridgen/region.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/named_files.h"
#include "base/number.h"
#include "gridgen/svg_path.h"
#include "io/grid_file.h"
#include "pelage/error.h"
#include "recipe/document.h"

namespace pelage {

namespace {

using Numbers = std::map<std::string, double>;

/// A grid of more nodes along an axis is no picture of anything.
constexpr double most_nodes = 10000;

Formula formula(const Value& v) {
  if (v.kind() == Value::Kind::number) return {exact_number(v.number()), v.where()};
  return {v.string(), v.text_where()};
}

Point read_point(const Value& v) {
  const auto& items = v.items();
  if (items.size() != 2 && items.size() != 3) throw Error(Fault::usage, "a point is [X, Y] or [X, Y, Z]", v.where());
  Point p{};
  for (std::size_t k = 0; k < items.size(); ++k) {
    p[k] = items[k].number();
    if (!std::isfinite(p[k])) throw Error(Fault::usage, "a coordinate must be finite", items[k].where());
  }
  return p;
}

/// x, y and z as formulas; z may be left out.
std::array<FormulaFunction, 3> read_formulas(const Value& table, const std::vector<std::string>& variables,
                                             const Numbers& numbers) {
  const auto read = [&](const char* key) { return FormulaFunction(formula(table.at(key)), variables, numbers); };
  const FormulaFunction zero({"0", table.where()}, variables);
  return {read("x"), read("y"), table.find("z") ? read("z") : zero};
}

/// Points of an outline need not repeat the first one.
Curve read_points(const Value& v, bool closed) {
  std::vector<Point> points;
  for (const Value& item : v.items()) points.push_back(read_point(item));
  if (closed && !points.empty() && points.front() != points.back()) points.push_back(points.front());
  const std::size_t least = closed ? 4 : 2;
  if (points.size() < least)
    throw Error(Fault::usage, closed ? "an outline needs at least three points" : "a side needs at least two points",
                v.where());
  return polyline(std::move(points), v.where());
}

Curve read_svg(const Value& v, bool closed) {
  const Value* data = v.find("d");
  Formula path;
  if (data) {
    path = {data->string(), data->text_where()};
  } else {
    const Value& file = v.at("file");
    path = svg_file_path(named_file(file.string(), file.where()), v.string_or("path", ""));
  }
  SvgPath read = parse_svg_path(path);
  if (closed && !read.closed)
    throw Error(Fault::usage, "the path is open; end it with Z, or where it begins", path.where);
  return std::move(read.curve);
}

/// Whether an outline crosses itself is asked of all pairs of its pieces.
Curve of_few_pieces(Curve curve, const Location& where) {
  constexpr std::size_t most = 10000;
  const std::size_t pieces = curve.knots.size() - 1;
  if (pieces > most)
    throw Error(
        Fault::usage,
        "a curve of " + std::to_string(pieces) + " pieces; at most " + std::to_string(most) + " are taken: simplify it",
        where);
  return curve;
}

/// A curve in any of its forms.
Curve read_curve(const Value& v, bool closed, const Numbers& numbers) {
  const Value *points = v.find("points"), *formulas = v.find("formula"), *svg = v.find("svg");
  if ((points != nullptr) + (formulas != nullptr) + (svg != nullptr) != 1)
    throw Error(Fault::usage, "a curve is given by one of \"points\", \"formula\" and \"svg\"", v.where());
  if (points) return of_few_pieces(read_points(*points, closed), v.where());
  if (svg) return of_few_pieces(read_svg(*svg, closed), v.where());
  return formula_curve(read_formulas(*formulas, {"t"}, numbers), formulas->where());
}

Outline::Corner read_corner(const Value& v) {
  if (v.kind() != Value::Kind::number) return {{}, read_point(v), v.where()};
  if (!(v.number() >= 0 && v.number() <= 1))
    throw Error(Fault::usage, "a corner is a point, or a parameter of the outline from 0 to 1", v.where());
  return {v.number(), {}, v.where()};
}

Outline read_outline(const Value& v, const Numbers& numbers) {
  Outline outline{read_curve(v, true, numbers), {}};
  if (const Value* corners = v.find("corners")) {
    for (const Value& corner : corners->items()) outline.corners.push_back(read_corner(corner));
    if (outline.corners.size() != 4) throw Error(Fault::usage, "an outline has four corners", corners->where());
  }
  return outline;
}

std::int32_t read_count(const Value& v) {
  const double n = v.number();
  if (!(n >= 2 && n <= most_nodes) || n != std::floor(n))
    throw Error(Fault::usage, "a grid needs 2 to 10000 nodes along each axis", v.where());
  return static_cast<std::int32_t>(n);
}

void read_nodes(const Value& document, Region& region) {
  region.nodes_where = region.where;
  const Value* v = document.find("nodes");
  if (!v) return;
  const std::size_t axes = region.volume ? 3 : 2;
  if (v->items().size() != axes)
    throw Error(Fault::usage, region.volume ? "nodes are [ALONG, ACROSS, UP]" : "nodes are [ALONG, ACROSS]",
                v->where());
  region.nodes_where = v->where();
  if (region.volume) region.volume->nodes = read_count(v->items()[2]);
  for (std::size_t k = 0; k < 2; ++k) region.nodes[k] = read_count(v->items()[k]);
}

GridWeights read_weights(const Value& document) {
  const Value* v = document.find("weights");
  if (!v) return {};
  const GridWeights w{v->number_or("length", 0), v->number_or("smoothness", 0), v->number_or("area", 0),
                      v->number_or("orthogonality", 0)};
  const double sum = w.length + w.smoothness + w.area + w.orthogonality;
  if (!(std::min({w.length, w.smoothness, w.area, w.orthogonality}) >= 0 && sum > 0 && std::isfinite(sum)))
    throw Error(Fault::usage, "weights are numbers of at least 0, one of them greater", v->where());
  return w;
}

Numbers read_numbers(const Value& document) {
  Numbers numbers;
  if (const Value* v = document.find("parameters"))
    for (const auto& [name, value] : v->entries()) numbers[name] = value->number();
  return numbers;
}

bool read_periodic(const Value& document) {
  const Value* v = document.find("periodic");
  if (v && v->string() != "x") throw Error(Fault::usage, "the first axis alone can be periodic: \"x\"", v->where());
  return v;
}

std::array<Curve, 4> read_face(const Value& document, const std::string& key, const Numbers& numbers) {
  const Value& face = document.at(key);
  const auto side = [&](const char* name) { return read_curve(face.at(name), false, numbers); };
  return {side(side_names[0]), side(side_names[1]), side(side_names[2]), side(side_names[3])};
}

std::optional<Volume> read_volume(const Value& document, const Numbers& numbers) {
  if (!document.find("bottom") && !document.find("top")) return {};
  Volume volume{
      read_face(document, "bottom", numbers), read_face(document, "top", numbers), {}, {}, 21, document.where()};
  if (const Value* pillars = document.find("pillars"))
    for (std::size_t k = 0; k < 4; ++k)
      if (const Value* pillar = pillars->find(pillar_names[k])) volume.given[k] = read_curve(*pillar, false, numbers);
  return volume;
}

/// The sides that a region needs, and no others.
void read_border(const Value& document, const Numbers& numbers, Region& region) {
  if (const Value* outline = document.find("outline")) {
    region.outline = read_outline(*outline, numbers);
    if (region.ring) throw Error(Fault::usage, "a ring has two closed sides, south and north", outline->where());
    return;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const bool along = k % 2 == 0;
    const Value* side = document.find(side_names[k]);
    if (region.ring && !along && side)
      throw Error(Fault::usage, std::string("a ring has no side ") + side_names[k] + "; leave it out", side->where());
    if (region.ring && !along) continue;
    if (!side)
      throw Error(
          Fault::usage,
          std::string("the side ") + side_names[k] + " is missing; give south, east, north and west, or one outline",
          region.where);
    region.sides[k] = read_curve(*side, region.ring, numbers);
  }
}

/// field = "FILE", or { file = "FILE", box = [[X, Y], [X, Y]] }: what the text of a formula reads of it.
std::shared_ptr<const PlaneField> read_field(const Value& v, const std::string& reader) {
  const bool plain = v.kind() == Value::Kind::string;
  const Value& file = plain ? v : v.at("file");
  const std::string path = named_file(file.string(), file.where());
  const Grid sheet = read_grid(path).grid;
  std::shared_ptr<PlaneField> field;
  try {
    field = std::make_shared<PlaneField>(sheet, names_read(sheet, reader));
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
  const Value* box = plain ? nullptr : v.find("box");
  if (!box) return field;
  if (box->items().size() != 2)
    throw Error(Fault::usage, "a box is two opposite corners, [[X, Y], [X, Y]]", box->where());
  const Point low = read_point(box->items()[0]), high = read_point(box->items()[1]);
  if (!(low[0] < high[0] && low[1] < high[1]))
    throw Error(Fault::usage, "the first corner of a box lies below and to the left of the second", box->where());
  field->lay_between({low[0], low[1]}, {high[0], high[1]});
  return field;
}

std::optional<NodeDensity> read_attraction(const Value& document, const Numbers& numbers) {
  const Value *v = document.find("attract"), *file = document.find("field");
  if (file && !v) throw Error(Fault::usage, "a field is what attract reads; give that formula, too", file->where());
  if (!v) return {};
  const Formula attract = formula(*v);
  std::shared_ptr<const PlaneField> field;
  if (file) field = read_field(*file, attract.text);
  return NodeDensity(FormulaFunction(attract, NodeDensity::variables(field.get()), numbers), field);
}

}  // namespace

Region parse_region(std::string_view text, const std::string& file) {
  const Value document = parse_document(text, file);
  Region region;
  region.where = document.where();
  region.name = document.string_or("name", std::filesystem::path(file).stem().string());
  region.summary = document.string_or("summary", "");
  const Numbers numbers = read_numbers(document);
  region.volume = read_volume(document, numbers);
  read_nodes(document, region);
  region.ring = read_periodic(document);
  if (!region.volume) read_border(document, numbers, region);
  region.weights = read_weights(document);
  region.attract = read_attraction(document, numbers);
  if (const Value* v = document.find("surface")) region.surface = read_formulas(*v, {"u", "v"}, numbers);
  document.require_all_read();
  if (region.volume && (region.ring || region.attract || region.surface))
    throw Error(Fault::usage, "a volume is not periodic, attracts no nodes and lies on no surface", region.where);
  return region;
}

}  // namespace pelage
