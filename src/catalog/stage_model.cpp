#include "catalog/stage_model.h"

#include <algorithm>

#include "base/suggest.h"
#include "run/program.h"

namespace pelage {

namespace {

// Names of definitions that nobody else will choose.
constexpr const char *mask_name = "stage_mask", *size_name = "stage_size";

Formula formula(const Given<std::string>& given) { return {given.value, given.where}; }

std::vector<std::string> species_names(const ModelSource& model) {
  std::vector<std::string> names;
  for (const SpeciesSource& s : model.species) names.push_back(s.name);
  return names;
}

void require_known_species(const ModelSource& model, const std::vector<Stage::SpeciesFormula>& list) {
  const std::vector<std::string> names = species_names(model);
  for (const auto& [species, given] : list)
    if (std::ranges::count(names, species) == 0)
      throw Error(Fault::usage, unknown_name("species", species, names), given.where);
}

/// Changes a formula, if there is one, to another text made from its own.
template <class Text>
void rewrite(std::optional<Formula>& f, Text&& text) {
  if (f) f->text = text("(" + f->text + ")");
}

/// Parameters with a formula become definitions, before those that use them.
void map_parameters(ModelSource& model, const Stage& stage) {
  std::size_t count = 0;
  for (const Stage::Setting& s : stage.parameters) {
    if (s.formula.empty()) continue;
    const auto found = std::ranges::find(model.parameters, s.name, &ParameterSource::name);
    if (found == model.parameters.end()) {
      std::vector<std::string> names;
      for (const ParameterSource& p : model.parameters) names.push_back(p.name);
      throw Error(Fault::usage, unknown_name("parameter", s.name, names), s.where);
    }
    model.parameters.erase(found);
    const DefinitionSource map{s.name, {s.formula, s.where}};
    model.definitions.insert(model.definitions.begin() + static_cast<std::ptrdiff_t>(count++), map);
  }
}

void define(ModelSource& model, const std::string& name, const Given<std::string>& given) {
  model.definitions.push_back({name, formula(given)});
}

/// Fields of an earlier stage that the new one starts from.
void carry_over(ModelSource& model, const Stage& stage, const std::vector<std::string>& fields) {
  if (!stage.from) return;
  std::vector<std::string> stages;
  for (const std::string& field : fields)
    if (const std::string name = field.substr(0, field.find('.')); std::ranges::count(stages, name) == 0)
      stages.push_back(name);
  if (std::ranges::count(stages, stage.from->value) == 0)
    throw Error(Fault::usage, unknown_name("earlier stage", stage.from->value, stages), stage.from->where);
  for (SpeciesSource& s : model.species) {
    const std::string field = field_name(stage.from->value, s.name);
    if (!s.equals && std::ranges::count(fields, field) > 0) s.initial = Formula{field, stage.from->where};
  }
}

void set_initial(ModelSource& model, const Stage& stage) {
  require_known_species(model, stage.initial);
  for (const auto& [species, given] : stage.initial) {
    const std::string name = "stage_initial_" + species;
    define(model, name, given);
    std::ranges::find(model.species, species, &SpeciesSource::name)->initial = Formula{name, given.where};
  }
}

void set_pins(ModelSource& model, const Stage& stage) {
  require_known_species(model, stage.pin);
  for (const auto& [species, given] : stage.pin) {
    if (!stage.mask) throw Error(Fault::usage, "there is nothing to pin without a mask", given.where);
    const std::string name = "stage_pin_" + species;
    define(model, name, given);
    std::ranges::find(model.species, species, &SpeciesSource::name)->pin = Formula{name, given.where};
  }
}

/// Changes what a species diffuses by: the diffusion or C1, which is 1 where only C0 is given, and the rates a1, a2.
template <class Scalar, class Rate>
void rewrite_diffusion(SpeciesSource& s, Scalar&& scalar, Rate&& rate) {
  if (s.c0 && !s.c1) s.c1 = Formula{"1", s.c0->where};
  rewrite(s.diffusion, scalar);
  rewrite(s.c1, scalar);
  if (!s.anisotropy) return;
  for (Formula* f : {&s.anisotropy->a1, &s.anisotropy->a2}) f->text = rate("(" + f->text + ")");
}

/// Neither reaction nor diffusion inside of the mask.
void exclude(ModelSource& model) {
  const auto outside = [](const std::string& text) { return std::string("if(") + mask_name + ", 0, " + text + ")"; };
  for (SpeciesSource& s : model.species) {
    rewrite_diffusion(s, outside, outside);
    for (auto* f : {&s.rate, &s.c2, &s.c3}) rewrite(*f, outside);
  }
}

/// Lengths scale with the root of the diffusion.
void scale_sizes(ModelSource& model, const Stage& stage) {
  if (!stage.size_map) return;
  define(model, size_name, *stage.size_map);
  const auto length = [](const std::string& text) { return text + "*" + size_name; };
  const auto area = [](const std::string& text) { return text + "*" + size_name + "^2"; };
  for (SpeciesSource& s : model.species) rewrite_diffusion(s, area, length);
}

}  // namespace

ModelSource stage_model(const ModelSource& plain, const Stage& stage, const std::vector<std::string>& fields) {
  ModelSource model = plain;
  map_parameters(model, stage);
  if (stage.points) model.definitions.push_back({"points", {"attribute(points)", stage.points->where}});
  if (stage.mask) define(model, mask_name, *stage.mask);
  carry_over(model, stage, fields);
  set_initial(model, stage);
  set_pins(model, stage);
  scale_sizes(model, stage);
  if (!stage.mask) return model;
  if (stage.inside.value == "excluded") exclude(model);
  model.held = Formula{mask_name, stage.mask->where};
  return model;
}

}  // namespace pelage
