#include "catalog/stage_changes.h"

#include <algorithm>

#include "base/suggest.h"
#include "run/program.h"

namespace pelage {

namespace {

Formula formula(const Given<std::string>& given) { return {given.value, given.where}; }

template <class Source>
std::vector<std::string> names_of(const std::vector<Source>& sources) {
  std::vector<std::string> names;
  for (const Source& s : sources) names.push_back(s.name);
  return names;
}

/// Formulas of species that the model has.
std::vector<ModelChanges::OfSpecies> of_species(const ModelSource& model,
                                                const std::vector<Stage::SpeciesFormula>& list) {
  const std::vector<std::string> names = names_of(model.species);
  std::vector<ModelChanges::OfSpecies> result;
  for (const auto& [species, given] : list) {
    if (std::ranges::count(names, species) == 0)
      throw Error(Fault::usage, unknown_name("species", species, names), given.where);
    result.push_back({species, formula(given)});
  }
  return result;
}

std::vector<DefinitionSource> maps(const ModelSource& model, const Stage& stage) {
  const std::vector<std::string> names = names_of(model.parameters);
  std::vector<DefinitionSource> result;
  for (const Stage::Setting& s : stage.parameters) {
    if (s.formula.empty()) continue;
    if (std::ranges::count(names, s.name) == 0)
      throw Error(Fault::usage, unknown_name("parameter", s.name, names), s.where);
    result.push_back({s.name, {s.formula, s.where}});
  }
  return result;
}

/// Fields of an earlier stage that the new one starts from.
std::vector<ModelChanges::OfSpecies> carried(const ModelSource& model, const Stage& stage,
                                             const std::vector<std::string>& fields) {
  if (!stage.from) return {};
  std::vector<std::string> stages;
  for (const std::string& field : fields)
    if (const std::string name = field.substr(0, field.find('.')); std::ranges::count(stages, name) == 0)
      stages.push_back(name);
  if (std::ranges::count(stages, stage.from->value) == 0)
    throw Error(Fault::usage, unknown_name("earlier stage", stage.from->value, stages), stage.from->where);
  std::vector<ModelChanges::OfSpecies> result;
  for (const SpeciesSource& s : model.species) {
    const std::string field = field_name(stage.from->value, s.name);
    if (!s.equals && std::ranges::count(fields, field) > 0) result.push_back({s.name, {field, stage.from->where}});
  }
  return result;
}

}  // namespace

ModelChanges stage_changes(const ModelSource& model, const Stage& stage, const std::vector<std::string>& fields) {
  ModelChanges changes;
  changes.maps = maps(model, stage);
  if (stage.points) changes.points = stage.points->where;
  if (stage.mask) changes.mask = formula(*stage.mask);
  changes.excluded = stage.inside.value == "excluded";
  changes.carried = carried(model, stage, fields);
  changes.initial = of_species(model, stage.initial);
  changes.pin = of_species(model, stage.pin);
  if (!changes.pin.empty() && !changes.mask)
    throw Error(Fault::usage, "there is nothing to pin without a mask", changes.pin.front().formula.where);
  if (stage.size_map) changes.size = formula(*stage.size_map);
  return changes;
}

}  // namespace pelage
