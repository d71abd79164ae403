#include "studio/catalogue.h"

#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "catalog/analysis.h"
#include "catalog/models.h"
#include "catalog/plan.h"
#include "catalog/recipes.h"
#include "look/ramp.h"
#include "pelage/error.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "shape/generators.h"

namespace pelage {

namespace {

Header recipes() {
  Header list = Header::array();
  for (const std::string& name : recipe_names()) {
    const Recipe recipe = load_recipe(name);
    list.push_back({{"name", name}, {"summary", recipe.summary}, {"shape", recipe.shape}});
  }
  return list;
}

Header models() {
  Header list = Header::array();
  for (const ModelEntry& entry : model_list()) {
    const ModelSource& source = entry.source;
    if (entry.name != source.name) continue;  // a variant
    Header variants = Header::array(), species = Header::array();
    for (const VariantSource& v : source.variants) variants.push_back({{"name", v.name}, {"summary", v.title}});
    for (const SpeciesSource& s : source.species) species.push_back(s.name);
    list.push_back({{"name", source.name},
                    {"title", source.title},
                    {"summary", source.summary},
                    {"variants", variants},
                    {"species", species},
                    {"parameters", described(source.parameters)}});
  }
  return list;
}

Header ramps() {
  constexpr int samples = 33;
  Header list = Header::array();
  for (const std::string& name : ramp_names()) {
    const Ramp ramp = named_ramp(name);
    Header colors = Header::array();
    for (int i = 0; i < samples; ++i) {
      const Color c = ramp(i / double{samples - 1});
      colors.push_back({srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2])});
    }
    list.push_back({{"name", name}, {"colors", colors}});
  }
  return list;
}

Header shapes() {
  Header list = Header::array();
  for (const std::string& name : builtin_shape_names()) list.push_back({{"name", "builtin:" + name}});
  return list;
}

/// Growth rates of waves from a fifth to five times the length that grows fastest, in even ratios.
void add_dispersion(const Analysis& a, Header& header) {
  constexpr int samples = 241;
  constexpr double reach = 5;
  const std::optional<double> middle = a.stability.wavelength ? a.stability.wavelength
                                       : a.spacing            ? a.spacing
                                                              : a.resolved;
  Header lengths = Header::array(), rates = Header::array();
  if (middle && !a.states.empty())
    for (int i = 0; i < samples; ++i) {
      const double wavelength = *middle * std::pow(reach, 2.0 * i / (samples - 1) - 1);
      lengths.push_back(wavelength);
      rates.push_back(growth_rate(a.stability, 2 * std::numbers::pi / wavelength).real());
    }
  header["wavelengths"] = lengths;
  header["growth_rates"] = rates;
}

Header optional_number(const std::optional<double>& value) { return value ? Header(*value) : Header(nullptr); }

}  // namespace

Header described(const std::vector<ParameterSource>& parameters) {
  Header list = Header::array();
  for (const ParameterSource& p : parameters)
    list.push_back({{"name", p.name}, {"value", p.value}, {"low", p.min}, {"high", p.max}, {"meaning", p.help}});
  return list;
}

Message catalogue() {
  Message m;
  m.header = {{"recipes", recipes()},           {"models", models()},         {"ramps", ramps()}, {"shapes", shapes()},
              {"reads", readable_extensions()}, {"writes", mesh_extensions()}};
  return m;
}

Model planned_model(const Recipe& recipe, std::size_t stage) {
  const Plan planned = plan(recipe);
  if (stage >= planned.stages.size())
    throw Error(Fault::usage, "the recipe has " + std::to_string(planned.stages.size()) + " stages");
  return planned.stages[stage].model;
}

Message analysed(const Recipe& recipe, std::size_t stage) {
  const Analysis a = analysis_of(planned_model(recipe, stage));
  Header conditions = Header::array();
  for (const Condition& c : a.conditions) conditions.push_back({{"text", c.text}, {"holds", c.holds}});
  Message m;
  m.header = {{"title", a.title},
              {"verdict", a.verdict},
              {"wavelength", optional_number(a.stability.wavelength)},
              {"spacing", optional_number(a.spacing)},
              {"conditions", conditions},
              {"thresholds", a.thresholds_in_words}};
  add_dispersion(a, m.header);
  return m;
}

}  // namespace pelage
