#include "catalog/resolve.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/number.h"
#include "base/suggest.h"
#include "catalog/embedded.h"
#include "catalog/models.h"
#include "catalog/names.h"
#include "catalog/size.h"
#include "catalog/size_map.h"
#include "catalog/stage_directions.h"
#include "catalog/stage_model.h"
#include "catalog/textures.h"
#include "discretise/discretisation.h"
#include "look/layers.h"
#include "look/ramp.h"
#include "react/place_values.h"
#include "run/random_points.h"
#include "shape/vectors.h"
#include "time/stepper.h"

namespace pelage {

namespace {

const std::vector<std::string> methods = {"loop", "linear"};

void require_known(const Given<std::string>& name, const std::string& kind, const std::vector<std::string>& known) {
  for (const std::string& k : known)
    if (k == name.value) return;
  throw Error(Fault::usage, unknown_name(kind, name.value, known), name.where);
}

Overrides numbers_of(const Stage& stage) {
  Overrides overrides;
  for (const Stage::Setting& s : stage.parameters)
    if (s.formula.empty()) overrides[s.name] = Override(s.value, s.where);
  return overrides;
}

/// A trial on no samples finds attributes and fields that do not exist. (A stand-in without triangles has no
/// attributes, and then only fields are looked for.)
void require_places(const Model& model, const TriangleMesh& shape, const std::vector<Texture>& textures,
                    const std::vector<std::string>& more) {
  Places places = named_places(shape, textures);
  for (const std::string& name : more) places.attributes[name] = {};
  if (shape.triangles.empty())
    for (const Symbol& s : place_symbols(model))
      if (s.kind == Symbol::Kind::attribute && s.name.find('.') == std::string::npos) places.attributes[s.name] = {};
  Kinetics(model, places, 0);
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

/// Names of all fields that these stages leave behind.
std::vector<std::string> earlier_fields(const std::vector<Program>& stages) {
  std::vector<std::string> names;
  for (const Program& stage : stages)
    for (std::size_t i = 0; i < stage.model.species_count(); ++i)
      names.push_back(field_name(stage.name, stage.model.species_name(i)));
  return names;
}

void require_stage_names(const std::vector<Stage>& stages) {
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Given<std::string>& name = stages[k].name;
    require_name(name);
    for (std::size_t other = 0; other < k; ++other)
      if (stages[other].name.value == name.value)
        throw Error(Fault::usage, "two stages are called \"" + name.value + "\"", name.where);
  }
}

/// All stages live on one mesh.
void require_same_method(const Stage& first, const Stage& stage) {
  if (stage.method.value != first.method.value && stage.method.where.line > 0)
    throw Error(Fault::usage, "all stages have the method of the first, \"" + first.method.value + "\"",
                stage.method.where);
}

void require_paper_can(const Model& model, const Location& where) {
  if (!model.coupled().empty())
    throw Error(Fault::usage,
                "the stepper \"paper\" cannot grow \"" + model.name() +
                    "\", whose species are coupled by lap(); take \"sbdf2\"",
                where);
  if (model.held())
    throw Error(Fault::usage, "the stepper \"paper\" cannot hold parts of the surface; take \"sbdf2\"", where);
}

Program resolve_stage(const Recipe& recipe, std::size_t number, const TriangleMesh& shape,
                      const std::vector<Texture>& textures, const std::vector<Program>& before) {
  const Stage &stage = recipe.stages[number], &first = recipe.stages[0];
  require_known(stage.method, "method", methods);
  require_known(stage.stepper, "stepper", stepper_names());
  require_known(stage.inside, "way to treat the inside of a mask", {"frozen", "excluded"});
  require_same_method(first, stage);
  Program p;
  p.textures = textures;
  p.name = stage.name.value;
  p.model_name = stage.model.value;
  std::vector<std::string> known = earlier_fields(before);
  const ModelSource source = load_model(stage.model.value);
  const Model plain =
      compile(source, numbers_of(stage));  // faults of the model itself are found before those of the stage
  p.model = compile(stage_model(source, stage, known), numbers_of(stage));
  if (stage.points) known.push_back(points_attribute);
  require_places(p.model, shape, textures, known);
  if (stage.stepper.value == "paper") require_paper_can(p.model, stage.stepper.where);
  p.method = first.method.value;
  p.stepper = stage.stepper.value;
  const double diagonal = bounding_diagonal(shape);
  if (!(diagonal > 0)) throw Error(Fault::input, "the shape has no extent: all its vertices are at one place");
  const StageSize size = stage_size(stage, plain, diagonal);
  p.size = size.wavelength;
  p.length_unit = size.length_unit;
  if (stage.directions) p.directions = resolve_directions(stage, p.model, shape, textures, diagonal);
  p.excluded = stage.inside.value == "excluded";
  if (stage.points) p.points = world_length(stage.points->value, diagonal);
  const Suggestions& suggested = p.model.source().suggestions;
  p.step = stage.step;
  p.suggested_step = suggested.step.value_or(1);
  p.resolution = suggested.resolution_or_default();
  p.until = stage.until.value_or(suggested.end.value_or(1000));
  p.steps = stage.steps;
  p.stationary = stage.stationary.value_or(suggested.tolerance.value_or(0));
  p.seed = stage.seed;
  for (const Stage& s : recipe.stages) p.interpolate |= s.interpolate;
  return p;
}

/// Layers know the species of the last stage as attributes, too.
void require_no_species(const std::vector<TextureFile>& textures, const Model& last) {
  for (const TextureFile& t : textures)
    for (std::size_t i = 0; i < last.species_count(); ++i)
      if (last.species_name(i) == t.name.value)
        throw Error(Fault::usage, "the texture \"" + t.name.value + "\" is called like a species; give it another name",
                    t.name.where);
}

/// Species, ramp, layers.
void require_look(const Look& look, const std::vector<Program>& stages, const TriangleMesh& shape) {
  require_known(look.ramp, "ramp", ramp_names());
  std::vector<std::string> species;
  const Model& last = stages.back().model;
  for (std::size_t i = 0; i < last.species_count(); ++i) species.push_back(last.species_name(i));
  const std::vector<std::string> fields = earlier_fields(stages);
  Places places = named_places(shape, stages[0].textures);
  for (const std::string& name : species) places.attributes[name] = {};
  for (const std::string& name : fields) places.attributes[name] = {};
  std::vector<double> no_colors;
  if (!shape.triangles.empty() || look.layers.empty()) paint(look.layers, species, places, no_colors);
  species.insert(species.end(), fields.begin(), fields.end());
  if (look.species) require_known(*look.species, "species", species);
}

}  // namespace

std::vector<Program> resolve(const Recipe& recipe, TriangleMesh shape) {
  require_stage_names(recipe.stages);
  const std::vector<Texture> textures = resolve_textures(recipe.textures, shape);
  std::vector<Program> stages;
  double edge = std::numeric_limits<double>::infinity(), until = 0;
  for (std::size_t k = 0; k < recipe.stages.size(); ++k) {
    const Program& p = stages.emplace_back(resolve_stage(recipe, k, shape, textures, stages));
    const double own_edge = p.size / p.resolution;
    edge = std::min(edge, own_edge * smallest_factor(recipe.stages[k], shape, textures, own_edge));
    until += p.until;
  }
  require_no_species(recipe.textures, stages.back().model);
  require_look(recipe.look, stages, shape);
  const SurfaceMotion motion = resolve_motion(recipe.motion, until);
  for (Program& p : stages) p.motion = motion;
  stages[0].edge = edge / std::exp(std::max(0.0, motion.growth * until));
  stages[0].shape = std::move(shape);
  return stages;
}

void check_names(const Recipe& recipe) {
  TriangleMesh stand_in;  // of extent 1
  stand_in.points = {{0, 0, 0}, {1, 0, 0}};
  resolve(recipe, std::move(stand_in));
}

std::string fit_method(Recipe& recipe, const TriangleMesh& mesh) {
  Given<std::string>& method = recipe.stages[0].method;
  if (method.value != "loop" || method.where.line > 0) return "";
  const Index valence = max_valence(make_topology(mesh.points.size(), mesh.triangles));
  if (valence <= max_loop_valence) return "";
  method.value = "linear";
  return "a vertex has " + std::to_string(valence) + " edges, more than the " + std::to_string(max_loop_valence) +
         " that Loop elements take; using --method linear";
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
