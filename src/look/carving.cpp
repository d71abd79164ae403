#include "look/carving.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/box.h"
#include "base/number.h"
#include "base/suggest.h"
#include "look/comparison.h"
#include "look/cut_tessellation.h"
#include "look/solid_tessellation.h"
#include "pelage/error.h"
#include "shape/grid.h"
#include "shape/normals.h"
#include "shape/tet_mesh.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

// --- cuts of space ---

/// The direction that pictures look from, between the axes: toward +x and up, and along the other one to +z, or -y.
Point viewer(UpAxis up) { return up == UpAxis::y ? Point{1, 1, 1} : Point{1, -1, 1}; }

std::vector<double> values_at(const PlaceFormula& formula, const std::vector<Point>& places) {
  return formula.at({.positions = places});
}

PlaceFormula formula_of(const std::string& text, const std::string& formula) {
  PlaceFormula result({formula, {"--cut " + text}});
  for (const Symbol& s : result.symbols())
    if (s.kind != Symbol::Kind::position)
      throw Error(Fault::usage, "--cut " + text + ": reads more than the coordinates x, y and z");
  return result;
}

PlaceFormula kept_side(const std::string& text, const std::string& condition, UpAxis up) {
  const std::optional<ComparedFormulas> c = compared(condition);
  if (!c)
    throw Error(Fault::usage, "--cut " + text +
                                  ": expected what is cut away, for example \"x<0\", \"x+y>1\", \"x>0 and y>0\" or "
                                  "\"z=0\", in which case it is the side that pictures look from");
  const std::string difference = "(" + c->left + ") - (" + c->right + ")", minus = "-(" + difference + ")";
  PlaceFormula formula = formula_of(text, difference);
  if (c->sign == '<') return formula;
  if (c->sign == '>') return formula_of(text, minus);
  const std::vector<double> ends = values_at(formula, {{0, 0, 0}, viewer(up)});
  return ends[1] > ends[0] ? formula_of(text, minus) : formula;
}

/// The texts between words " and ".
std::vector<std::string> conditions(const std::string& text) {
  static const std::string word = " and ";
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end = 0; end < text.size(); begin = end + word.size()) {
    end = std::min(text.find(word, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

/// A linear function: gradient . x + value.
struct Linear {
  Point gradient;
  double value;
};

/// The values as a linear function, if they are one.
std::optional<Linear> linear(const PlaceFormula& formula, const std::vector<Point>& nodes,
                             const std::vector<double>& values) {
  const auto [low, high] = box_of(nodes);
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  std::vector<Point> ends(4, low);
  for (std::size_t d = 0; d < 3; ++d) ends[d + 1][d] += size;
  const std::vector<double> at = values_at(formula, ends);
  Linear f{{}, at[0]};
  for (std::size_t d = 0; d < 3; ++d) f.gradient[d] = (at[d + 1] - at[0]) / size;
  f.value -= dot(f.gradient, low);
  double largest = 0, away = 0;
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    largest = std::max(largest, std::abs(values[v]));
    away = std::max(away, std::abs(values[v] - dot(f.gradient, nodes[v]) - f.value));
  }
  constexpr double rounding = 1e-9;
  return away <= rounding * largest ? std::optional(f) : std::nullopt;
}

// --- levels ---

double number_in(const std::string& text, const std::string& whole) {
  double value = 0;
  const char* begin = text.data() + std::min(text.find_first_not_of(' '), text.size());
  const auto [end, fault] = std::from_chars(begin, text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size())
    throw Error(Fault::usage,
                "--isosurface " + whole + ": expected a number behind " + whole.substr(0, whole.find(text)));
  return value;
}

std::size_t index_of(const std::string& species, const CoatFields& fields) {
  const auto found = std::ranges::find(fields.species, species);
  if (found == fields.species.end())
    throw Error(Fault::usage, "--isosurface: " + unknown_name("species", species, fields.species));
  return static_cast<std::size_t>(found - fields.species.begin());
}

Cut cut_of(const LevelPart& part, const CoatFields& fields) {
  std::vector<double> values = fields.coefficients[index_of(part.species, fields)];
  if (part.above) return level_cut(values, *part.level);
  for (double& x : values) x = -x;
  return level_cut(values, -*part.level);
}

// --- the body ---

const std::vector<Point>& places_of(const Tessellation& nodes) { return nodes.samples.position; }

std::vector<Cut> cuts_of(const std::vector<SpaceCut>& cuts, const std::vector<Point>& nodes) {
  std::vector<Cut> all;
  for (const SpaceCut& cut : cuts)
    for (Cut& c : cut.at(nodes)) all.push_back(std::move(c));
  constexpr std::size_t most = 30;
  if (all.size() > most) throw Error(Fault::usage, "--cut: more than " + std::to_string(most) + " conditions");
  return all;
}

/// Colours are linear along edges; with so many per wavelength their borders are smooth.
constexpr double edges_per_wavelength = 24;
constexpr std::size_t most_triangles = 1'500'000;

/// Of the volume, cut and split as far as its colours need.
CarvedBody body_of(const CoatFields& fields, const std::vector<Cut>& cuts) {
  const auto* tets = as<TetMesh>(fields.nodes);
  CarvedBody body = tets ? carve(*tets, cuts) : carve(*as<Grid>(fields.nodes), cuts);
  if (body.triangles.empty()) throw Error(Fault::usage, "--cut leaves nothing of the shape");
  double edge = tets ? mean_edge(*tets) : mean_edge(*as<Grid>(fields.nodes));
  for (; edge > fields.wavelength / edges_per_wavelength && 4 * body.triangles.size() <= most_triangles; edge /= 2)
    body.refine();
  return body;
}

Tessellation at_vertices(const Tessellation& nodes, const CarvedBody& body) {
  Tessellation t;
  t.triangles = body.triangles;
  t.samples = nodes.samples;
  t.samples.position = body.places(places_of(nodes));
  if (!nodes.samples.drawn_at.empty()) t.samples.drawn_at = body.places(nodes.samples.drawn_at);
  t.samples.normal.assign(body.vertices(), {});
  for (std::vector<double>& field : t.samples.fields) field = body.at_vertices(field, 1);
  for (auto& [name, values] : t.samples.attributes) values = body.at_vertices(values, 1);
  for (const Attribute& a : nodes.attributes) t.attributes.push_back(body.at_vertices(a));
  t.metres_per_unit = nodes.metres_per_unit;
  return t;
}

}  // namespace

SpaceCut::SpaceCut(const std::string& text, UpAxis up) {
  for (const std::string& condition : conditions(text)) kept_.push_back(kept_side(text, condition, up));
  if (kept_.empty()) kept_.push_back(kept_side(text, "", up));
}

std::vector<Cut> SpaceCut::at(const std::vector<Point>& nodes) const {
  std::vector<Cut> cuts;
  for (const PlaceFormula& kept : kept_) {
    const std::vector<double> values = values_at(kept, nodes);
    const std::optional<Linear> f = linear(kept, nodes, values);
    cuts.push_back(f ? plane_cut(nodes, {-f->gradient[0], -f->gradient[1], -f->gradient[2]}, f->value)
                     : level_cut(values, 0));
    cuts.back().and_next = true;
  }
  cuts.back().and_next = false;
  return cuts;
}

LevelPart parse_level_part(const std::string& text) {
  const std::optional<ComparedFormulas> c = compared(text);
  std::string species = c ? c->left : text;
  std::erase(species, ' ');
  if (species.empty() || species.find_first_of("<>=") != std::string::npos)
    throw Error(Fault::usage, "--isosurface " + text + ": expected SPECIES, SPECIES=LEVEL or SPECIES<LEVEL");
  if (!c) return {species, {}, true};
  return {species, number_in(c->right, text), c->sign != '<'};
}

bool leaves_something(const NodeShape& volume, const std::vector<Point>& nodes, const std::vector<SpaceCut>& cuts) {
  const std::vector<Cut> all = cuts_of(cuts, nodes);
  const auto* tets = std::get_if<TetMesh>(&volume);
  return !(tets ? carve(*tets, all) : carve(std::get<Grid>(volume), all)).triangles.empty();
}

std::string fit_level(Carving& carving, const CoatFields& fields) {
  if (!carving.part) return "";
  LevelPart& part = *carving.part;
  const auto [low, high] = std::ranges::minmax(fields.coefficients[index_of(part.species, fields)]);
  if (low == high) {
    const std::string species = part.species;
    carving.part.reset();
    return species + " is " + number(low) + " everywhere: it has no isosurface, and the whole volume is shown";
  }
  const double middle = (low + high) / 2, level = part.level.value_or(middle);
  const bool inside = level > low && level < high;
  part.level = inside ? level : middle;
  if (inside) return "";
  return "the isosurface is at " + number(middle) + ", since " + part.species + " lies between " + number(low) +
         " and " + number(high);
}

TriangleMesh dress_body(const CoatFields& fields, const Look& look, const Carving& carving) {
  const Paint paint = resolve_paint(look, fields.species);
  const TessellationRequest request = tessellation_request(look, paint);
  const Tessellation nodes = tessellate_nodes(fields, request);
  const Palette palette = make_palette(paint, nodes.samples, fields.uniform);
  if (carving.empty() && shows_surface(fields.nodes)) return dress(tessellate_for(fields, look, paint), palette);
  std::vector<Cut> cuts = cuts_of(carving.cuts, places_of(nodes));
  if (carving.part) cuts.insert(cuts.begin(), cut_of(*carving.part, fields));
  const CarvedBody body = body_of(fields, cuts);
  TriangleMesh mesh = dress(at_vertices(nodes, body), palette);
  mesh.set(corner_normals(body.triangles, mesh.points, body.side));
  return mesh;
}

}  // namespace pelage
