#include "catalog/plan.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/suggest.h"
#include "catalog/brushes.h"
#include "catalog/models.h"
#include "catalog/names.h"
#include "catalog/size.h"
#include "catalog/stage_changes.h"
#include "react/place_values.h"
#include "react/wavelength.h"
#include "run/program.h"
#include "run/random_points.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// The component of that name, or of that older name.
template <class Component>
const Component& component(const Given<std::string>& name, const std::string& kind,
                           const std::vector<const Component*>& known) {
  std::vector<std::string> names;
  for (const Component* c : known) {
    if (c->name == name.value) return *c;
    if constexpr (requires { c->alias; })
      if (!c->alias.empty() && c->alias == name.value) return *c;
    names.emplace_back(c->name);
  }
  throw Error(Fault::usage, unknown_name(kind, name.value, names), name.where);
}

void require_known(const Given<std::string>& name, const std::string& kind, const std::vector<std::string>& known) {
  if (std::ranges::count(known, name.value) == 0)
    throw Error(Fault::usage, unknown_name(kind, name.value, known), name.where);
}

Overrides numbers_of(const Stage& stage) {
  Overrides overrides;
  for (const Stage::Setting& s : stage.parameters)
    if (s.formula.empty()) overrides[s.name] = Override(s.value, s.where);
  return overrides;
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

/// What keeps a stepper from the borders that the stage asks for; empty if nothing does.
std::string what_borders_need(const StepperKind& stepper, const std::vector<Stage::Border>& borders) {
  if (borders.empty()) return {};
  if (stepper.lattice) return "let anything through borders";
  const bool values = std::ranges::any_of(borders, [](const auto& b) { return b.value.has_value(); });
  return values && !stepper.gives_values ? "give values at borders" : "";
}

/// A number of cells asks for the method.
void take_cells(const std::optional<Given<std::int64_t>>& cells, Plan& p) {
  if (!cells) return;
  p.cells = cells;
  if (!p.method_asked) p.method = &cell_method;
  p.method_asked = true;
  if (!p.method->fits || !p.method->fits(Cells{}))
    throw Error(Fault::usage,
                "the method \"" + std::string(p.method->name) + "\" has no cells; take \"" +
                    std::string(cell_method.name) + "\", or leave their number out",
                cells->where);
}

/// What keeps a stepper from growing a model with a method; empty if nothing does.
std::string what_stepper_cannot(const StepperKind& stepper, const Method& method, const Model& model,
                                const Stage& stage) {
  if (std::string what = what_borders_need(stepper, stage.boundary); !what.empty()) return what;
  if (!stage.solver.value.empty() && !stepper.solves)
    return "use the solver \"" + stage.solver.value + "\": it solves no linear systems";
  if (stage.refresh && !stepper.refreshes) return "keep its matrices for some steps: it makes none of the fields";
  if (!stepper.couples && !model.coupled().empty())
    return "grow \"" + model.name() + "\", whose species are coupled by lap()";
  if (!stepper.holds && model.held()) return "hold parts of the surface";
  if (stepper.lattice && !method.make_node_space) return "grow on a surface: it is for even grids";
  if (!method.symmetric && (stepper.symmetric || !model.coupled().empty()))
    return "grow \"" + model.name() + "\" with the method \"" + std::string(method.name) +
           "\", whose matrices are not symmetric";
  if (stepper.nodal && !method.nodal)
    return "grow with the method \"" + std::string(method.name) + "\", whose unknowns are no values at places";
  return {};
}

/// Error(usage) where it cannot grow the model; the stepper that can do most, or the method, is to blame then.
const StepperKind& require_able(const StepperKind& stepper, const Method& method, const Model& model,
                                const Stage& stage, const Location& where) {
  const std::string what = what_stepper_cannot(stepper, method, model, stage);
  const std::string other = method.symmetric
                                ? "take \"" + std::string((stage.refresh ? semi_implicit : sbdf2).name) + "\""
                                : "take another stepper, or the method \"" +
                                      std::string((method.fits(Cells{}) ? cell_method : grid_method).name) + "\"";
  if (!what.empty())
    throw Error(Fault::usage, "the stepper \"" + std::string(stepper.name) + "\" cannot " + what + "; " + other, where);
  return stepper;
}

/// The asked one, or else the first that can.
const StepperKind* fitting_stepper(const Stage& stage, const Method& method, const Model& model, const Motion& motion,
                                   const Components& components) {
  const Given<std::string>& asked = stage.stepper;
  if (asked.value.empty()) {
    const bool dilutes = motion.growth != 0 && motion.mode.value == "physical";
    const auto can = [&](const StepperKind* kind) {
      return what_stepper_cannot(*kind, method, model, stage).empty() && (kind->dilutes || !dilutes);
    };
    if (const auto found = std::ranges::find_if(components.steppers, can); found != components.steppers.end())
      return *found;
    return &require_able(sbdf2, method, model, stage, {});
  }
  return &require_able(component(asked, "stepper", components.steppers), method, model, stage, asked.where);
}

const SolverKind* chosen_solver(const Given<std::string>& asked, const Model& model, const Components& components) {
  if (asked.value.empty()) return components.solvers.front();
  const SolverKind& solver = component(asked, "solver", components.solvers);
  if (!model.coupled().empty())
    throw Error(
        Fault::usage,
        "species that are coupled by lap() are solved for together, by conjugate gradients; leave the solver out",
        asked.where);
  return &solver;
}

const Quality& quality_called(const Given<std::string>& name) {
  std::vector<const Quality*> known;
  for (const Quality& q : qualities()) known.push_back(&q);
  return component(name, "quality", known);
}

/// Names of all fields that these stages leave behind.
std::vector<std::string> earlier_fields(const std::vector<PlannedStage>& stages) {
  std::vector<std::string> names;
  for (const PlannedStage& stage : stages)
    for (std::size_t i = 0; i < stage.model.species_count(); ++i)
      names.push_back(field_name(stage.asked.name.value, stage.model.species_name(i)));
  return names;
}

bool is_field(const Symbol& s) { return s.kind == Symbol::Kind::attribute && s.name.find('.') != std::string::npos; }

void require_fields(const std::vector<Symbol>& symbols, const std::vector<std::string>& known) {
  for (const Symbol& s : symbols)
    if (is_field(s)) require_attribute(s, known);
}

/// Whether the formula depends on no more than a mesh tells: neither curvatures nor fields of earlier stages.
bool known_from_mesh(const PlaceFormula& formula) {
  return std::ranges::none_of(formula.symbols(),
                              [](const Symbol& s) { return s.kind == Symbol::Kind::curvature || is_field(s); });
}

std::optional<PlaceFormula> marks(const std::optional<Given<std::string>>& text) {
  if (!text) return {};
  PlaceFormula formula({text->value, text->where});
  if (!known_from_mesh(formula))
    throw Error(Fault::usage, "what marks vertices cannot depend on curvatures or on earlier stages", text->where);
  return formula;
}

void plan_directions(const Directions& d, PlannedStage& stage) {
  if (!stage.model.anisotropic())
    throw Error(Fault::usage, "model \"" + stage.model.name() + "\" diffuses the same in all directions", d.where);
  if (d.axis && length(*d.axis) == 0) throw Error(Fault::usage, "the axis has length 0", d.where);
  stage.from = marks(d.from);
  stage.to = marks(d.to);
}

std::map<std::string, double> parameters_of(const Model& model) {
  std::map<std::string, double> numbers;
  for (const ParameterSource& p : model.parameters()) numbers[p.name] = p.value;
  return numbers;
}

std::vector<BorderCondition> plan_borders(const Stage& stage, const Model& model) {
  std::vector<BorderCondition> borders;
  std::vector<std::string> species;
  for (std::size_t i = 0; i < model.species_count(); ++i) species.push_back(model.species_name(i));
  for (const Stage::Border& b : stage.boundary) {
    require_known(b.species, "species", species);
    BorderCondition& c = borders.emplace_back(BorderCondition{b.side.value, b.side.where, 0, {}, {}, {}});
    c.species = static_cast<std::size_t>(std::ranges::find(species, b.species.value) - species.begin());
    if (model.algebraic(c.species) || std::ranges::count(model.coupled(), c.species) > 0)
      throw Error(Fault::usage, "at borders species that are coupled by lap(), or follow others, have no flux",
                  b.species.where);
    for (const auto& [given, planned] :
         {std::pair{&b.value, &c.value}, std::pair{&b.flux, &c.flux}, std::pair{&b.loss, &c.loss}})
      if (*given) planned->emplace(Formula{(*given)->value, (*given)->where}, parameters_of(model));
  }
  return borders;
}

std::optional<PlaceFormula> plan_size_map(const Stage& stage, const Model& model) {
  if (!stage.size_map) return {};
  PlaceFormula formula({stage.size_map->value, stage.size_map->where}, {}, parameters_of(model));
  return known_from_mesh(formula) ? std::optional(std::move(formula)) : std::nullopt;
}

/// Where the model's unit is given, the wavelength serves the mesh alone: where none is known, what diffusion needs.
void set_wavelength(const Model& model, PlannedStage& stage) {
  const auto resolved = stage.asked.unit && !known_wavelength(model) ? diffusion_length(model) : std::nullopt;
  stage.wavelength_known = !resolved;
  stage.wavelength = resolved ? *resolved : model_wavelength(model);
}

/// Beyond these it is a slip: of so many steps none sees the end, and of a step so much longer nothing is left.
constexpr double most_steps = 1e12, longest_step = 1000;

/// Before any work: steps and an end that have something to do with each other.
void require_sensible_steps(const PlannedStage& p) {
  const double step = p.asked.step.value_or(p.model.source().suggestions.step.value_or(1));
  const std::string what = "a step of " + number(step) + " until time " + number(p.until);
  if (p.asked.step && p.until > 0 && step > longest_step * p.until)
    throw Error(Fault::usage, what + " is far longer than all of the growth; give a smaller one");
  if (!p.asked.steps && p.until > most_steps * step)
    throw Error(Fault::usage, what + " takes more than a million million steps; give another step, end, or --steps");
}

/// What its own file has to say is located there already.
ModelSource model_of(const Given<std::string>& name, const ModelTexts& texts) {
  try {
    return find_model(name.value, texts);
  } catch (const Error& error) {
    if (!error.where().file.empty()) throw;
    throw Error(error.fault(), error.what(), name.where);
  }
}

PlannedStage plan_stage(const Stage& stage, const Recipe& recipe, const Method& method,
                        const std::vector<PlannedStage>& before, const Components& components) {
  PlannedStage p;
  p.asked = stage;
  require_known(stage.inside, "way to treat the inside of a mask", {"frozen", "excluded"});
  require_same_method(recipe.stages[0], stage);
  const ModelSource source = model_of(stage.model, recipe.models);
  const Model plain = compile(source, numbers_of(stage));  // its own faults are found before those of the stage
  const std::vector<std::string> fields = earlier_fields(before);
  p.model = compile(source, numbers_of(stage), stage_changes(source, stage, fields));
  require_fields(place_symbols(p.model), fields);
  p.solver = chosen_solver(stage.solver, p.model, components);
  p.stepper = fitting_stepper(stage, method, p.model, recipe.motion, components);
  p.borders = plan_borders(stage, p.model);
  if (stage.directions) plan_directions(*stage.directions, p);
  p.size_map = plan_size_map(stage, p.model);
  require_sizes(stage);
  set_wavelength(plain, p);
  p.until = stage.until.value_or(source.suggestions.end.value_or(1000));
  require_sensible_steps(p);
  return p;
}

/// The mesh is made for the largest size of the surface; beyond this there are other mistakes.
constexpr double most_growth = 10;

void plan_motion(const Motion& motion, Plan& plan) {
  require_known(motion.mode, "mode of motion", {"texture", "physical"});
  if (motion.fair) {
    require_known(*motion.fair, "method of fairing", fair_methods());
    plan.fair.emplace().method = motion.fair->value;
  }
  if (!(std::abs(motion.growth * plan.until) <= std::log(most_growth)))
    throw Error(Fault::usage, "with a growth of " + number(motion.growth) + " until time " + number(plan.until) +
                                  " the surface changes its size by more than " + number(most_growth) +
                                  " times; lower one of them");
  plan.motion = motion;
}

void require_texture_names(const std::vector<TextureFile>& textures, const Model& last) {
  std::vector<std::string> taken = {points_attribute};
  for (const TextureFile& t : textures) {
    require_name(t.name);
    // Layers know the species of the last stage as attributes, too.
    for (std::size_t i = 0; i < last.species_count(); ++i)
      if (last.species_name(i) == t.name.value)
        throw Error(Fault::usage, "the texture \"" + t.name.value + "\" is called like a species; give it another name",
                    t.name.where);
    take_texture_name(t.name, taken);
  }
}

/// Fields that a look can show or read: those of earlier stages, then the species of the last.
std::vector<std::string> shown_fields(const std::vector<PlannedStage>& stages) {
  std::vector<std::string> names = earlier_fields({stages.begin(), stages.end() - 1});
  const Model& last = stages.back().model;
  for (std::size_t i = 0; i < last.species_count(); ++i) names.push_back(last.species_name(i));
  return names;
}

/// Whether a stepper is named that knows nothing but even grids.
bool asks_for_lattice(const std::vector<Stage>& stages, const Components& components) {
  return std::ranges::any_of(stages, [&](const Stage& stage) {
    return std::ranges::any_of(components.steppers, [&](const StepperKind* kind) {
      return kind->lattice && kind->name == stage.stepper.value;
    });
  });
}

}  // namespace

Look shown_look(const Recipe& recipe) {
  Look look = recipe.look;
  if (!look.ramp.value.empty() || !look.layers.empty()) return look;
  const Given<std::string>& model = recipe.stages.back().model;
  const Look own = model_look(model.value, recipe.models);
  look.ramp = own.ramp;
  look.invert ^= own.invert;
  if (!look.species) look.layers = own.layers;
  return look;
}

namespace {

std::optional<Given<double>> checked_crease(const std::optional<Given<double>>& degrees) {
  if (degrees && !(degrees->value > 0 && degrees->value < 180))
    throw Error(Fault::usage, "creases are told by an angle between 0 and 180 degrees", degrees->where);
  return degrees;
}

}  // namespace

Plan plan(const Recipe& recipe, const Components& components) {
  require_stage_names(recipe.stages);
  Plan p;
  const Given<std::string>& method = recipe.stages[0].method;
  p.method = &component(method, "method", components.methods);
  p.method_asked = !method.where.file.empty();
  if (!p.method_asked && asks_for_lattice(recipe.stages, components)) p.method = &grid_method;
  take_cells(recipe.stages[0].cells, p);
  p.quality = &quality_called(recipe.quality);
  p.textures = recipe.textures;
  p.brushes = recipe.brushes;
  for (const Stage& stage : recipe.stages) {
    p.stages.push_back(plan_stage(stage, recipe, *p.method, p.stages, components));
    p.until += p.stages.back().until;
    p.interpolate |= stage.interpolate;
    if (!p.crease) p.crease = checked_crease(stage.crease);
  }
  require_texture_names(recipe.textures, p.stages.back().model);
  require_brush_names(recipe.brushes, shown_fields(p.stages));
  p.paint = resolve_paint(shown_look(recipe), shown_fields(p.stages));
  require_fields(p.paint.symbols(), p.paint.species);
  plan_motion(recipe.motion, p);
  return p;
}

}  // namespace pelage
