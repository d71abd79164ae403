#include "catalog/resolve.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/number.h"
#include "base/suggest.h"
#include "catalog/embedded.h"
#include "catalog/models.h"
#include "catalog/stage_model.h"
#include "look/layers.h"
#include "look/ramp.h"
#include "react/place_formula.h"
#include "react/place_values.h"
#include "react/stability.h"
#include "run/random_points.h"
#include "shape/normals.h"
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
void require_places(const Model& model, const TriangleMesh& shape, const std::vector<std::string>& more) {
  Places places;
  for (const auto& [name, values] : scalar_attributes(shape.attributes)) places.attributes[name] = {};
  for (const std::string& name : more) places.attributes[name] = {};
  if (shape.triangles.empty())
    for (const Symbol& s : place_symbols(model))
      if (s.kind == Symbol::Kind::attribute && s.name.find('.') == std::string::npos) places.attributes[s.name] = {};
  Kinetics(model, places, 0);
}

double world_length(const std::optional<Given<Length>>& given, double diagonal) {
  const Length length = given ? given->value : Length{default_size, true};
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
    const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (!name.value.empty() &&
        (std::isdigit(static_cast<unsigned char>(name.value[0])) || !std::ranges::all_of(name.value, is_part)))
      throw Error(Fault::usage, "\"" + name.value + "\" is not a name; use letters, digits and _", name.where);
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

/// A formula of the place at the vertices of the shape; nothing where it depends on what is not known yet, or the shape
/// is a stand-in without vertices.
std::optional<std::vector<double>> values_at_vertices(const Given<std::string>& text, const TriangleMesh& shape,
                                                      std::uint64_t seed) {
  if (shape.triangles.empty()) return {};
  const PlaceFormula formula({text.value, text.where});
  for (const Symbol& s : formula.symbols())
    if (s.kind == Symbol::Kind::curvature || s.name.find('.') != std::string::npos) return {};
  const std::vector<Point> normals = vertex_normals(shape.triangles, shape.points);
  const VertexAttributes attributes = scalar_attributes(shape.attributes);
  Places places{.positions = shape.points, .normals = normals};
  for (const auto& [name, values] : attributes) places.attributes[name] = values;
  return formula.at(places, seed);
}

/// The vertices where a formula is not 0.
std::vector<Index> marked(const Given<std::string>& text, const TriangleMesh& shape, std::uint64_t seed) {
  const auto values = values_at_vertices(text, shape, seed);
  if (!values) {
    if (shape.triangles.empty()) return {};
    throw Error(Fault::usage, "what marks vertices cannot depend on curvatures or on earlier stages", text.where);
  }
  std::vector<Index> vertices;
  for (std::size_t v = 0; v < values->size(); ++v)
    if ((*values)[v] != 0) vertices.push_back(static_cast<Index>(v));
  if (vertices.empty()) throw Error(Fault::usage, "this marks no vertex of the shape", text.where);
  return vertices;
}

FieldWish resolve_directions(const Stage& stage, const Model& model, const TriangleMesh& shape, double diagonal) {
  const Directions& d = *stage.directions;
  if (!model.anisotropic())
    throw Error(Fault::usage, "model \"" + model.name() + "\" diffuses the same in all directions", d.where);
  if (d.axis && length(*d.axis) == 0) throw Error(Fault::usage, "the axis has length 0", d.where);
  FieldWish wish;
  wish.axis = d.axis;
  wish.curvature = d.curvature;
  wish.strokes = d.strokes;
  if (d.from) {
    wish.from = marked(*d.from, shape, stage.seed);
    wish.to = marked(*d.to, shape, stage.seed);
  }
  wish.across = d.across;
  wish.smooth = default_field_smoothing * diagonal;
  return wish;
}

/// The smallest factor of a size map over the vertices of the shape; 1 where the map depends on what is not known yet.
double smallest_factor(const Stage& stage, const TriangleMesh& shape) {
  if (!stage.size_map) return 1;
  const auto factors = values_at_vertices(*stage.size_map, shape, stage.seed);
  if (!factors) return 1;
  const double smallest = std::ranges::min(*factors);
  if (!(smallest > 0))
    throw Error(Fault::usage, "the map of the size is " + number(smallest) + " somewhere; it must be greater than 0",
                stage.size_map->where);
  return smallest;
}

Program resolve_stage(const Recipe& recipe, std::size_t number, const TriangleMesh& shape,
                      const std::vector<Program>& before) {
  const Stage &stage = recipe.stages[number], &first = recipe.stages[0];
  require_known(stage.method, "method", methods);
  require_known(stage.stepper, "stepper", stepper_names());
  require_known(stage.inside, "way to treat the inside of a mask", {"frozen", "excluded"});
  require_same_method(first, stage);
  Program p;
  p.name = stage.name.value;
  p.model_name = stage.model.value;
  std::vector<std::string> known = earlier_fields(before);
  const ModelSource source = load_model(stage.model.value);
  const Model plain =
      compile(source, numbers_of(stage));  // faults of the model itself are found before those of the stage
  p.model = compile(stage_model(source, stage, known), numbers_of(stage));
  if (stage.points) known.push_back(points_attribute);
  require_places(p.model, shape, known);
  if (stage.stepper.value == "paper") require_paper_can(p.model, stage.stepper.where);
  p.method = first.method.value;
  p.stepper = stage.stepper.value;
  const double diagonal = bounding_diagonal(shape);
  if (!(diagonal > 0)) throw Error(Fault::input, "the shape has no extent: all its vertices are at one place");
  p.size = world_length(stage.size, diagonal);
  p.length_unit = p.size / model_wavelength(plain);
  if (stage.directions) p.directions = resolve_directions(stage, p.model, shape, diagonal);
  p.excluded = stage.inside.value == "excluded";
  if (stage.points) p.points = world_length(stage.points, diagonal);
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

/// Species, ramp, layers.
void require_look(const Look& look, const std::vector<Program>& stages, const TriangleMesh& shape) {
  require_known(look.ramp, "ramp", ramp_names());
  std::vector<std::string> species;
  const Model& last = stages.back().model;
  for (std::size_t i = 0; i < last.species_count(); ++i) species.push_back(last.species_name(i));
  const std::vector<std::string> fields = earlier_fields(stages);
  Places places;
  for (const auto& [name, values] : scalar_attributes(shape.attributes)) places.attributes[name] = {};
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
  std::vector<Program> stages;
  double edge = std::numeric_limits<double>::infinity(), until = 0;
  for (std::size_t k = 0; k < recipe.stages.size(); ++k) {
    stages.push_back(resolve_stage(recipe, k, shape, stages));
    edge = std::min(edge, stages[k].size / stages[k].resolution * smallest_factor(recipe.stages[k], shape));
    until += stages[k].until;
  }
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
