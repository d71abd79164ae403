#include "pelage/recipe_changes.h"

#include <algorithm>
#include <utility>

#include "base/suggest.h"
#include "catalog/size.h"
#include "discretise/method.h"
#include "pelage/channel.h"
#include "recipe/setting.h"

namespace pelage {

namespace {

template <class T, class Target>
void override(const std::optional<T>& given, Target& target) {
  if (given) target = *given;
}

void override(const std::optional<std::string>& given, Given<std::string>& target) {
  if (given) target = {*given, {}};
}

/// Reads the texts of the changes; `option` is what messages call the one that a text belongs to.
class Change {
 public:
  Change(const RecipeChanges& changes, const std::string& name, const std::string& text = {})
      : option_(changes.prefix + name), said_(option_ + (text.empty() ? "" : " " + text)) {}

  const std::string& option() const { return option_; }
  Location where() const { return {option_}; }
  [[noreturn]] void refuse(const std::string& why) const { throw Error(Fault::usage, said_ + why); }

  /// The stage that "STAGE.NAME" speaks of, with "NAME" left; of a recipe with a single stage also without "STAGE.".
  Stage& stage_of(std::vector<Stage>& stages, std::string& name) const {
    std::vector<std::string> names;
    for (const Stage& stage : stages) names.push_back(stage.name.value);
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) {
      if (stages.size() == 1) return stages[0];
      refuse(": the recipe has several stages; write STAGE." + name + "=..., with one of " + join_names(names));
    }
    const std::string stage = name.substr(0, dot);
    name.erase(0, dot + 1);
    for (std::size_t k = 0; k < stages.size(); ++k)
      if (names[k] == stage || "stage" + std::to_string(k + 1) == stage) return stages[k];
    refuse(": " + unknown_name("stage", stage, names));
  }

  /// What stands before and behind the first "="; `expected` is what the message asks for when one of them is missing.
  std::pair<std::string, std::string> sides(const std::string& text, const std::string& expected) const {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) refuse(": expected " + expected);
    return {text.substr(0, equals), text.substr(equals + 1)};
  }

 private:
  std::string option_, said_;
};

/// A setting replaces that of the recipe.
void override_parameter(std::vector<Stage::Setting>& settings, const Stage::Setting& given) {
  std::erase_if(settings, [&](const Stage::Setting& s) { return s.name == given.name; });
  settings.push_back(given);
}

void apply_setting(const RecipeChanges& changes, const std::string& text, std::vector<Stage>& stages) {
  const Change change(changes, "set", text);
  const std::size_t equals = std::min(text.find('='), text.size());
  std::string name = text.substr(0, equals);
  Stage& stage = change.stage_of(stages, name);
  if (name == "size" && equals < text.size()) {
    stage.size = {parse_length(text.substr(equals + 1), {}), {}};
    stage.unit.reset();
  } else {
    override_parameter(stage.parameters, parse_setting(name + text.substr(equals), change.option()));
  }
}

void apply_map(const RecipeChanges& changes, const std::string& text, std::vector<Stage>& stages) {
  const Change change(changes, "param-map", text);
  auto [name, formula] = change.sides(text, "PARAM=FORMULA, for example beta=attribute:age");
  const std::string prefix = "attribute:";
  if (formula.starts_with(prefix)) formula = "attribute(" + formula.substr(prefix.size()) + ")";
  Stage& stage = change.stage_of(stages, name);
  if (name == "size")
    stage.size_map = {formula, change.where()};
  else
    override_parameter(stage.parameters, Stage::Setting{name, 0, change.where(), formula});
}

/// Instead of one of that name.
void apply_texture(const RecipeChanges& changes, const std::string& text, std::vector<TextureFile>& textures) {
  const Change change(changes, "texture", text);
  const auto [name, file] = change.sides(text, "NAME=FILE, for example age=age.png");
  std::erase_if(textures, [&name = name](const TextureFile& t) { return t.name.value == name; });
  textures.push_back({{name, change.where()}, file});
}

/// Instead of the recipe's.
void apply_channel(const RecipeChanges& changes, const std::string& text, Look& look) {
  const auto [name, formula] =
      Change(changes, "material", text).sides(text, "CHANNEL=FORMULA, for example roughness=0.3");
  const Change change(changes, "material");
  std::vector<std::string> known;
  for (const ChannelKind& kind : channel_kinds) known.emplace_back(kind.name);
  const auto found = std::ranges::find(known, name);
  if (found == known.end()) change.refuse(": " + unknown_name("channel", name, known));
  look.channels[channel_kinds[static_cast<std::size_t>(found - known.begin())].channel] = {formula, change.where()};
}

/// The size of the first stage; those of the others keep their proportion to it.
void apply_size(const RecipeChanges& changes, std::vector<Stage>& stages) {
  const Length size = parse_length(*changes.size, {});
  if (stages.size() == 1) stages[0].unit.reset();
  const Length before = stages[0].size ? stages[0].size->value : Length{default_size};
  for (Stage& stage : stages) {
    const Length own = stage.size ? stage.size->value : Length{default_size};
    if (own.unit != before.unit || stage.unit)
      Change(changes, "size")
          .refuse(": the stages of the recipe have sizes of different kinds; use " + changes.prefix +
                  "set STAGE.size=");
    stage.size = {{own.value / before.value * size.value, size.unit}, {}};
  }
}

/// The model unit of the only stage, instead of a size.
void apply_unit(const RecipeChanges& changes, std::vector<Stage>& stages) {
  if (stages.size() > 1)
    Change(changes, "unit").refuse(": the recipe has several stages; give each of them its own in the recipe");
  stages[0].size.reset();
  stages[0].unit = {parse_length(*changes.unit, {}), {}};
}

void apply_to_each(const RecipeChanges& c, Stage& stage) {
  const auto where = [&](const char* name) { return Change(c, name).where(); };
  if (c.method) stage.method = {*c.method, where("method")};
  if (c.solid) stage.method = {std::string(tets_method.name), where("solid")};
  if (c.cells) stage.cells = Given<std::int64_t>{*c.cells, where("cells")};
  override(c.stepper, stage.stepper);
  if (c.solver) stage.solver = {*c.solver, where("solver")};
  if (c.refresh) stage.refresh = Given<std::int64_t>{*c.refresh, where("refresh")};
  override(c.step, stage.step);
  override(c.until, stage.until);
  override(c.steps, stage.steps);
  override(c.stationary, stage.stationary);
  override(c.seed, stage.seed);
  stage.interpolate |= c.interpolate;
  if (c.crease) stage.crease = Given<double>{*c.crease, where("crease")};
}

void apply(const RecipeChanges& c, std::vector<Stage>& stages) {
  if (c.model && stages.size() > 1)
    Change(c, "model").refuse(": the recipe has several stages; give either a recipe or a model");
  override(c.model, stages[0].model);
  if (c.size && c.unit)
    Change(c, "size").refuse(" and " + c.prefix + "unit: give one of them, since the other follows from it");
  if (c.size) apply_size(c, stages);
  if (c.unit) apply_unit(c, stages);
  for (const std::string& text : c.settings) apply_setting(c, text, stages);
  for (const std::string& text : c.maps) apply_map(c, text, stages);
  for (Stage& stage : stages) apply_to_each(c, stage);
}

void apply(const RecipeChanges& c, Motion& motion) {
  if (!c.fair.empty()) motion.fair = {c.fair, {}};
  override(c.growth, motion.growth);
  override(c.motion, motion.mode);
  override(c.every, motion.every);
}

void apply(const RecipeChanges& c, Look& look) {
  if (c.species) look.species = {*c.species, {}};
  override(c.ramp, look.ramp);
  for (const std::string& text : c.channels) apply_channel(c, text, look);
  look.invert |= c.invert;
  look.keep_shape |= c.keep_shape;
  look.flat |= c.flat;
  look.displace |= c.displace;
  look.fields &= !c.no_fields;
  override(c.detail, look.detail);
  const auto name = [&](const char* option) { return c.prefix + option; };
  if (look.keep_shape && look.detail.value_or(0) > 0)
    Change(c, "keep-shape")
        .refuse(" splits nothing: leave " + name("detail") + " out, or take " + name("flat") + " instead");
  if (look.displace && look.keep_shape)
    Change(c, "keep-shape")
        .refuse(" moves nothing: leave " + name("displace") + " out, or take " + name("flat") + " instead");
  if (look.displace && !look.channels.contains(Channel::height))
    Change(c, "displace").refuse(" needs a height, for example " + name("material") + " height=0.1*b");
}

}  // namespace

Recipe with_changes(Recipe recipe, const RecipeChanges& changes) {
  for (const std::string& text : changes.textures) apply_texture(changes, text, recipe.textures);
  if (changes.quality) recipe.quality = {*changes.quality, Change(changes, "quality").where()};
  apply(changes, recipe.stages);
  apply(changes, recipe.motion);
  apply(changes, recipe.look);
  return recipe;
}

}  // namespace pelage
