#include "catalog/resolve.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/number.h"
#include "base/suggest.h"
#include "catalog/embedded.h"
#include "catalog/models.h"
#include "look/ramp.h"
#include "react/stability.h"
#include "run/place_fields.h"
#include "time/stepper.h"

namespace pelage {

namespace {

const std::vector<std::string> methods = {"loop", "linear"};

void require_known(const Given<std::string>& name, const std::string& kind, const std::vector<std::string>& known) {
  for (const std::string& k : known)
    if (k == name.value) return;
  throw Error(Fault::usage, unknown_name(kind, name.value, known), name.where);
}

Model resolve_model(const Stage& stage) {
  Overrides overrides;
  for (const Stage::Setting& s : stage.parameters) overrides[s.name] = Override(s.value, s.where);
  return compile(load_model(stage.model.value), overrides);
}

void require_species(const Look& look, const Model& model) {
  if (!look.species) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.species_count(); ++i) names.push_back(model.species_name(i));
  require_known(*look.species, "species", names);
}

/// A trial on no samples finds attributes that the shape does not have. (A stand-in without triangles has none.)
void require_attributes(const Model& model, const TriangleMesh& shape) {
  if (shape.triangles.empty()) return;
  Places places;
  for (const auto& [name, values] : scalar_attributes(shape)) places.attributes[name] = {};
  Kinetics(model, places, 0);
}

double world_size(const Stage& stage, double diagonal) {
  const Length length = stage.size ? stage.size->value : Length{default_size, true};
  return length.relative ? length.value * diagonal : length.value;
}

/// The mesh is made for the largest size of the surface; beyond this there are other mistakes.
constexpr double most_growth = 10;

SurfaceMotion resolve_motion(const Motion& motion, double until) {
  require_known(motion.mode, "mode of motion", {"texture", "physical"});
  SurfaceMotion m;
  if (motion.fair) {
    require_known(*motion.fair, "method of fairing", fair_methods());
    m.fair.emplace().method = motion.fair->value;
  }
  if (!(std::abs(motion.growth * until) <= std::log(most_growth)))
    throw Error(Fault::usage, "with a growth of " + number(motion.growth) + " until time " + number(until) +
                                  " the surface changes its size by more than " + number(most_growth) +
                                  " times; lower one of them");
  m.growth = motion.growth;
  m.physical = motion.mode.value == "physical";
  m.every = motion.every;
  return m;
}

constexpr std::string_view recipe_folder = "recipes/", extension = ".toml";

}  // namespace

Program resolve(const Recipe& recipe, TriangleMesh shape) {
  const Stage& stage = recipe.stage;
  require_known(stage.method, "method", methods);
  require_known(stage.stepper, "stepper", stepper_names());
  require_known(recipe.look.ramp, "ramp", ramp_names());
  Program p;
  p.model = resolve_model(stage);
  require_species(recipe.look, p.model);
  require_attributes(p.model, shape);
  if (stage.stepper.value == "paper" && !p.model.coupled().empty())
    throw Error(Fault::usage,
                "the stepper \"paper\" cannot grow \"" + p.model.name() +
                    "\", whose species are coupled by lap(); take \"sbdf2\"",
                stage.stepper.where);
  p.method = stage.method.value;
  p.stepper = stage.stepper.value;
  const double diagonal = bounding_diagonal(shape);
  if (!(diagonal > 0)) throw Error(Fault::input, "the shape has no extent: all its vertices are at one place");
  p.size = world_size(stage, diagonal);
  p.length_unit = p.size / model_wavelength(p.model);
  const Suggestions& suggested = p.model.source().suggestions;
  p.step = stage.step;
  p.suggested_step = suggested.step.value_or(1);
  p.resolution = suggested.resolution_or_default();
  p.until = stage.until.value_or(suggested.end.value_or(1000));
  p.steps = stage.steps;
  p.stationary = stage.stationary.value_or(suggested.tolerance.value_or(0));
  p.seed = stage.seed;
  p.interpolate = stage.interpolate;
  p.motion = resolve_motion(recipe.motion, p.until);
  p.shape = std::move(shape);
  return p;
}

std::vector<std::string> recipe_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& f : embedded_files())
    if (f.path.starts_with(recipe_folder))
      names.emplace_back(f.path.substr(recipe_folder.size(), f.path.size() - recipe_folder.size() - extension.size()));
  return names;
}

Recipe load_recipe(const std::string& name_or_path) {
  if (name_or_path.ends_with(extension)) {
    std::ifstream file(name_or_path);
    if (!file) throw Error(Fault::input, "cannot be read", {name_or_path});
    std::ostringstream text;
    text << file.rdbuf();
    return parse_recipe(text.str(), name_or_path);
  }
  for (const EmbeddedFile& f : embedded_files())
    if (f.path == std::string(recipe_folder) + name_or_path + std::string(extension))
      return parse_recipe(std::string(f.text), std::string(f.path));
  throw Error(Fault::usage, unknown_name("recipe", name_or_path, recipe_names()));
}

}  // namespace pelage
