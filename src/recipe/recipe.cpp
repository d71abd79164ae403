#include "pelage/recipe.h"

#include <charconv>
#include <cmath>

#include "base/ascii.h"
#include "base/length_unit.h"
#include "base/named_files.h"
#include "base/number.h"
#include "recipe/document.h"
#include "recipe/read_recipe.h"

namespace pelage {

namespace {

Given<std::string> given(const Value& v) { return {v.string(), v.where()}; }

void read_text(const Value& table, const std::string& key, Given<std::string>& target) {
  if (const Value* v = table.find(key)) target = given(*v);
}

/// Doubles hold whole numbers up to here exactly.
constexpr std::int64_t most_whole = 9'000'000'000'000'000;

std::int64_t whole_number(const Value& v, std::int64_t least, std::int64_t most = most_whole) {
  const double x = v.number();
  if (!(x >= static_cast<double>(least) && x <= static_cast<double>(most)) || x != std::floor(x))
    throw Error(Fault::usage, "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                v.where());
  return static_cast<std::int64_t>(x);
}

std::optional<double> positive(const Value& table, const std::string& key) {
  const Value* v = table.find(key);
  if (!v) return {};
  if (!(v->number() > 0)) throw Error(Fault::usage, key + " must be positive", v->where());
  return v->number();
}

/// Formulas are located at their first character.
Given<std::string> given_formula(const Value& v) { return {v.string(), v.text_where()}; }

std::optional<Given<std::string>> optional_formula(const Value& table, const std::string& key) {
  const Value* v = table.find(key);
  return v ? std::optional(given_formula(*v)) : std::nullopt;
}

std::optional<Given<std::string>> optional_text(const Value& table, const std::string& key) {
  const Value* v = table.find(key);
  return v ? std::optional(given(*v)) : std::nullopt;
}

std::optional<Given<Length>> optional_length(const Value& table, const std::string& key) {
  const Value* v = table.find(key);
  if (!v) return {};
  const bool plain = v->kind() == Value::Kind::number;
  return Given<Length>{plain ? Length{v->number()} : parse_length(v->string(), v->where()), v->where()};
}

Stage::Setting read_parameter(const std::string& name, const Value& v) {
  if (v.kind() == Value::Kind::number) return {name, v.number(), v.where()};
  return {name, 0, v.text_where(), v.string()};
}

Given<std::string> formula_or_number(const Value& v) {
  return v.kind() == Value::Kind::number ? Given<std::string>{exact_number(v.number()), v.where()} : given_formula(v);
}

/// Formulas, or numbers, by species.
std::vector<Stage::SpeciesFormula> read_species(const Value& table, const std::string& key) {
  std::vector<Stage::SpeciesFormula> list;
  const Value* formulas = table.find(key);
  if (!formulas) return list;
  for (const auto& [name, v] : formulas->entries()) list.push_back({name, formula_or_number(*v)});
  return list;
}

Stage::Border read_border(const std::string& side, const Location& side_at, const std::string& species,
                          const Value& table) {
  Stage::Border b{{side, side_at}, {species, table.where()}, {}, {}, {}};
  for (const auto& [key, target] :
       {std::pair{"value", &b.value}, std::pair{"flux", &b.flux}, std::pair{"loss", &b.loss}})
    if (const Value* v = table.find(key)) *target = formula_or_number(*v);
  if (b.value ? b.flux || b.loss : !b.flux && !b.loss)
    throw Error(Fault::usage, "at a border a species has either a value, or a flux, a loss or both", table.where());
  return b;
}

std::vector<Stage::Border> read_boundary(const Value& table) {
  std::vector<Stage::Border> list;
  for (const auto& [side, all] : table.entries())
    for (const auto& [species, conditions] : all->entries())
      list.push_back(read_border(side, all->where(), species, *conditions));
  return list;
}

Point read_point(const Value& v, const std::string& what) {
  if (v.items().size() != 3) throw Error(Fault::usage, what + " is [X, Y, Z]", v.where());
  return {v.items()[0].number(), v.items()[1].number(), v.items()[2].number()};
}

Directions read_directions(const Value& table) {
  Directions d;
  d.where = table.where();
  if (const Value* axis = table.find("axis")) d.axis = read_point(*axis, "an axis");
  if (const Value* centre = table.find("centre")) d.centre = read_point(*centre, "a centre");
  if (const Value* v = table.find("curvature")) d.curvature = v->boolean();
  d.from = optional_formula(table, "from");
  d.to = optional_formula(table, "to");
  if (const Value* strokes = table.find("strokes"))
    for (const Value& stroke : strokes->items()) {
      d.strokes.emplace_back();
      for (const Value& point : stroke.items()) d.strokes.back().push_back(read_point(point, "a point of a stroke"));
    }
  if (const Value* v = table.find("across")) d.across = v->boolean();
  if (d.from.has_value() != d.to.has_value())
    throw Error(Fault::usage, "directions along a gradient need both \"from\" and \"to\"", d.where);
  if (!d.axis && !d.centre && !d.curvature && !d.from && d.strokes.empty())
    throw Error(Fault::usage,
                "directions follow an axis, a centre, the curvature, the way from a place to another, or strokes",
                d.where);
  return d;
}

std::optional<Given<double>> read_jitter(const Value& table) {
  const Value* v = table.find("jitter");
  if (!v) return {};
  if (!(v->number() >= 0 && v->number() <= 1)) throw Error(Fault::usage, "jitter must be from 0 to 1", v->where());
  if (!table.find("points"))
    throw Error(Fault::usage, "jitter moves the points of a grid; give their spacing as points", v->where());
  return Given<double>{v->number(), v->where()};
}

Stage read_stage(const Value& table, std::size_t count) {
  Stage s;
  s.name.value = "stage" + std::to_string(count);
  read_text(table, "name", s.name);
  s.model = given(table.at("model"));
  s.model.value = named_text(s.model.value, s.model.where);
  if (const Value* v = table.find("parameters"))
    for (const auto& [name, value] : v->entries()) s.parameters.push_back(read_parameter(name, *value));
  s.size = optional_length(table, "size");
  s.unit = optional_length(table, "unit");
  s.size_map = optional_formula(table, "size-map");
  s.points = optional_length(table, "points");
  s.jitter = read_jitter(table);
  if (const Value* v = table.find("directions")) s.directions = read_directions(*v);
  s.from = optional_text(table, "from");
  s.initial = read_species(table, "initial");
  s.mask = optional_formula(table, "mask");
  read_text(table, "inside", s.inside);
  s.pin = read_species(table, "pin");
  if (const Value* v = table.find("boundary")) s.boundary = read_boundary(*v);
  read_text(table, "method", s.method);
  if (const Value* v = table.find("cells")) s.cells = Given<std::int64_t>{whole_number(*v, 1), v->where()};
  read_text(table, "stepper", s.stepper);
  read_text(table, "solver", s.solver);
  if (const Value* v = table.find("refresh")) s.refresh = Given<std::int64_t>{whole_number(*v, 1), v->where()};
  s.step = positive(table, "step");
  s.until = positive(table, "until");
  if (const Value* v = table.find("steps")) s.steps = whole_number(*v, 0);
  s.stationary = table.optional_number("stationary");
  if (const Value* v = table.find("seed")) s.seed = static_cast<std::uint64_t>(whole_number(*v, 0));
  if (const Value* v = table.find("interpolate")) s.interpolate = v->boolean();
  if (const Value* v = table.find("crease")) s.crease = Given<double>{v->number(), v->where()};
  return s;
}

TextureFile read_texture_file(const Value& table) {
  const Value& file = table.at("file");
  return {given(table.at("name")), named_file(file.string(), file.where())};
}

/// [texture], or [[texture]] several times.
std::vector<TextureFile> read_texture_files(const Value& given) {
  if (given.kind() != Value::Kind::array) return {read_texture_file(given)};
  std::vector<TextureFile> textures;
  for (const Value& table : given.items()) textures.push_back(read_texture_file(table));
  return textures;
}

double share(const Value& table, const std::string& key, double otherwise) {
  const Value* v = table.find(key);
  if (v && !(v->number() >= 0 && v->number() <= 1)) throw Error(Fault::usage, key + " must be from 0 to 1", v->where());
  return v ? v->number() : otherwise;
}

Brush::Stroke read_stroke(const Value& table) {
  Brush::Stroke stroke;
  for (const Value& point : table.at("points").items())
    stroke.points.push_back(read_point(point, "a point of a stroke"));
  if (stroke.points.empty()) throw Error(Fault::usage, "a stroke has at least one point", table.where());
  table.at("radius");
  stroke.radius = *optional_length(table, "radius");
  stroke.value = table.number_or("value", stroke.value);
  stroke.hardness = share(table, "hardness", stroke.hardness);
  return stroke;
}

/// [[brush]], each with [[brush.stroke]].
std::vector<Brush> read_brushes(const Value& list) {
  std::vector<Brush> brushes;
  for (const Value& table : list.items()) {
    Brush& brush = brushes.emplace_back(Brush{given(table.at("name")), {}});
    if (const Value* strokes = table.find("stroke"))
      for (const Value& stroke : strokes->items()) brush.strokes.push_back(read_stroke(stroke));
  }
  return brushes;
}

/// Whether stages can tell it from the path of a file and from a variant.
bool names_a_model(const std::string& name) {
  return !name.empty() &&
         std::ranges::all_of(name, [](char c) { return is_letter_or_digit(c) || c == '-' || c == '_'; });
}

/// [models]: each a text, which gets as many empty lines before it as make its lines those of the recipe.
ModelTexts read_models(const Value& table) {
  ModelTexts models;
  for (const auto& [name, text] : table.entries()) {
    if (!names_a_model(name))
      throw Error(Fault::usage, "a model has a name of letters, digits, - and _, which \"" + name + "\" is not",
                  text->where());
    const Location& begin = text->text_where();
    models[name] = {std::string(static_cast<std::size_t>(begin.line - 1), '\n') + text->string(), begin.file};
  }
  return models;
}

/// A dozen is much; each of them keeps its fields.
constexpr std::size_t most_stages = 100;

/// [stage], or [[stage]] several times.
std::vector<Stage> read_stages(const Value& given) {
  if (given.kind() != Value::Kind::array) return {read_stage(given, 1)};
  std::vector<Stage> stages;
  if (given.items().size() > most_stages)
    throw Error(Fault::usage, "a recipe has at most " + std::to_string(most_stages) + " stages",
                given.items()[most_stages].where());
  for (const Value& table : given.items()) stages.push_back(read_stage(table, stages.size() + 1));
  if (stages.empty()) throw Error(Fault::usage, "a recipe needs at least one stage", given.where());
  return stages;
}

/// "solid" is a short word for the method that fills the shape.
void read_solid(const Value& document, std::vector<Stage>& stages) {
  const Value* solid = document.find("solid");
  if (!solid || !solid->boolean()) return;
  for (Stage& s : stages) {
    if (!s.method.where.file.empty() && s.method.value != "tets")
      throw Error(Fault::usage, "a solid shape has the method \"tets\"; leave either \"solid\" or \"method\" out",
                  s.method.where);
    s.method = {"tets", solid->where()};
  }
}

Motion read_motion(const Value& table) {
  Motion m;
  if (const Value* v = table.find("fair")) {
    if (v->kind() != Value::Kind::boolean)
      m.fair = given(*v);
    else if (v->boolean())
      m.fair = {"guided", v->where()};
  }
  m.growth = table.number_or("growth", 0);
  read_text(table, "mode", m.mode);
  if (const Value* v = table.find("every")) m.every = whole_number(*v, 1);
  return m;
}

Layer read_layer(const Value& table) {
  Layer layer;
  layer.color = optional_text(table, "color");
  layer.ramp = optional_text(table, "ramp");
  layer.opacity = optional_formula(table, "opacity");
  if (layer.color.has_value() == layer.ramp.has_value())
    throw Error(Fault::usage, "a layer has either a color or a ramp", table.where());
  if (!layer.ramp) return layer;
  layer.value = given_formula(table.at("value"));
  if (const Value* range = table.find("range")) {
    if (range->items().size() != 2)
      throw Error(Fault::usage, "range is [LOW, HIGH], the values at the ends of the ramp", range->where());
    layer.low = range->items()[0].number();
    layer.high = range->items()[1].number();
  }
  if (layer.low == layer.high) throw Error(Fault::usage, "the ends of the range must differ", table.where());
  return layer;
}

}  // namespace

Look read_look(const Value& table) {
  Look look;
  if (const Value* v = table.find("species")) look.species = given(*v);
  read_text(table, "ramp", look.ramp);
  if (const Value* v = table.find("invert")) look.invert = v->boolean();
  if (const Value* v = table.find("keep-shape")) look.keep_shape = v->boolean();
  if (const Value* v = table.find("flat")) look.flat = v->boolean();
  if (const Value* v = table.find("layers"))
    for (const Value& layer : v->items()) look.layers.push_back(read_layer(layer));
  if (const Value* v = table.find("displace")) look.displace = v->boolean();
  for (const ChannelKind& kind : channel_kinds)
    if (const Value* v = table.find(std::string(kind.name))) look.channels[kind.channel] = formula_or_number(*v);
  if (const Value* v = table.find("detail")) look.detail = static_cast<int>(whole_number(*v, 0, most_detail));
  return look;
}

Length parse_length(const std::string& text, const Location& where) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string unit(static_cast<const char*>(end), text.data() + text.size());
  const std::optional<double> metres = metres_in(unit);
  const bool known = unit.empty() || unit == "u" || unit == "px" || metres;
  if (error != std::errc{} || !std::isfinite(number) || number <= 0 || !known)
    throw Error(Fault::usage,
                "'" + text +
                    "' is not a length; give a fraction of the shape's diagonal (0.04) or a length with its unit "
                    "(4mm, 2cm, 0.1m, 3in, 1ft, or 1.5u in units of the file, or 24px in cells of a grid)",
                where);
  if (metres) return {number * *metres, Length::Unit::metres};
  if (unit == "px") return {number, Length::Unit::cells};
  return {number, unit.empty() ? Length::Unit::diagonals : Length::Unit::world};
}

Recipe read_recipe(const Value& document, const std::string& file) {
  Recipe recipe;
  recipe.name = document.string_or("name", file);
  recipe.summary = document.string_or("summary", "");
  if (const Value* v = document.find("shape")) recipe.shape = named_shape(v->string(), v->where());
  read_text(document, "quality", recipe.quality);
  if (const Value* textures = document.find("texture")) recipe.textures = read_texture_files(*textures);
  if (const Value* brushes = document.find("brush")) recipe.brushes = read_brushes(*brushes);
  if (const Value* models = document.find("models")) recipe.models = read_models(*models);
  recipe.stages = read_stages(document.at("stage"));
  read_solid(document, recipe.stages);
  if (const Value* motion = document.find("motion")) recipe.motion = read_motion(*motion);
  if (const Value* look = document.find("look")) recipe.look = read_look(*look);
  return recipe;
}

Recipe parse_recipe(const std::string& text, const std::string& file) {
  const Value document = parse_document(text, file);
  if (!document.find("stage") && document.find("species"))
    throw Error(Fault::usage, "this is a model, not a recipe; give it as --model", {file});
  Recipe recipe = read_recipe(document, file);
  document.require_all_read();
  return recipe;
}

}  // namespace pelage
