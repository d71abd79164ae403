#include "pelage/recipe.h"

#include <charconv>
#include <cmath>

#include "recipe/document.h"

namespace pelage {

namespace {

Given<std::string> given(const Value& v) { return {v.string(), v.where()}; }

void read_text(const Value& table, const std::string& key, Given<std::string>& target) {
  if (const Value* v = table.find(key)) target = given(*v);
}

/// A whole number that a double can hold exactly.
std::int64_t whole_number(const Value& v, double least) {
  const double x = v.number();
  if (!(x >= least && x <= 9e15) || x != std::floor(x))
    throw Error(Fault::usage, "expected a whole number of at least " + std::to_string(static_cast<int>(least)),
                v.where());
  return static_cast<std::int64_t>(x);
}

std::optional<double> positive(const Value& table, const std::string& key) {
  const Value* v = table.find(key);
  if (!v) return {};
  if (!(v->number() > 0)) throw Error(Fault::usage, key + " must be positive", v->where());
  return v->number();
}

Stage read_stage(const Value& table) {
  Stage s;
  s.model = given(table.at("model"));
  if (const Value* v = table.find("parameters"))
    for (const auto& [name, value] : v->entries()) s.parameters.push_back({name, value->number(), value->where()});
  if (const Value* v = table.find("size"))
    s.size = {v->kind() == Value::Kind::number ? Length{v->number(), true} : parse_length(v->string(), v->where()),
              v->where()};
  read_text(table, "method", s.method);
  read_text(table, "stepper", s.stepper);
  s.step = positive(table, "step");
  s.until = positive(table, "until");
  if (const Value* v = table.find("steps")) s.steps = whole_number(*v, 0);
  s.stationary = table.optional_number("stationary");
  if (const Value* v = table.find("seed")) s.seed = static_cast<std::uint64_t>(whole_number(*v, 0));
  if (const Value* v = table.find("interpolate")) s.interpolate = v->boolean();
  return s;
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

Look read_look(const Value& table) {
  Look look;
  if (const Value* v = table.find("species")) look.species = given(*v);
  read_text(table, "ramp", look.ramp);
  if (const Value* v = table.find("invert")) look.invert = v->boolean();
  if (const Value* v = table.find("keep-shape")) look.keep_shape = v->boolean();
  if (const Value* v = table.find("detail")) look.detail = static_cast<int>(whole_number(*v, 0));
  return look;
}

/// World length of a unit: the metric units take the file's unit as a metre, as glTF does.
std::optional<double> unit_length(const std::string& unit) {
  if (unit == "u" || unit == "m") return 1;
  if (unit == "mm") return 1e-3;
  if (unit == "cm") return 1e-2;
  if (unit == "in") return 0.0254;
  return {};
}

}  // namespace

Length parse_length(const std::string& text, const Location& where) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string unit(static_cast<const char*>(end), text.data() + text.size());
  const std::optional<double> factor = unit_length(unit);
  if (error != std::errc{} || !std::isfinite(number) || number <= 0 || !(unit.empty() || factor))
    throw Error(Fault::usage,
                "'" + text +
                    "' is not a length; give a fraction of the shape's diagonal (0.04) or a length with its unit "
                    "(4mm, 2cm, 0.1m, 3in, or 1.5u in units of the file)",
                where);
  return unit.empty() ? Length{number, true} : Length{number * *factor, false};
}

Recipe parse_recipe(const std::string& text, const std::string& file) {
  const Value document = parse_document(text, file);
  Recipe recipe;
  recipe.name = document.string_or("name", file);
  recipe.summary = document.string_or("summary", "");
  recipe.shape = document.string_or("shape", "");
  recipe.stage = read_stage(document.at("stage"));
  if (const Value* motion = document.find("motion")) recipe.motion = read_motion(*motion);
  if (const Value* look = document.find("look")) recipe.look = read_look(*look);
  document.require_all_read();
  return recipe;
}

}  // namespace pelage
