#include <algorithm>
#include <cmath>
#include <optional>

#include "base/report.h"
#include "base/suggest.h"
#include "catalog/bind.h"
#include "catalog/images.h"
#include "catalog/plan.h"
#include "catalog/textured_coat.h"
#include "look/cut_tessellation.h"
#include "look/dress.h"
#include "look/kept_shape.h"
#include "pelage/grow.h"
#include "run/run.h"
#include "shape/triangulate.h"

namespace pelage {

namespace {

/// The last tessellation of a state that has not changed since.
class TessellationCache {
 public:
  void clear() { made_.reset(); }

  /// With curvatures and attributes even where none are asked for, if it is there.
  const Tessellation& of(const Run& run, const TessellationRequest& request) {
    if (!made_ || !serves(made_->request, request)) made_.emplace(Made{request, tessellate(run.fields(), request)});
    return made_->tessellation;
  }

 private:
  struct Made {
    TessellationRequest request;
    Tessellation tessellation;
  };

  static bool serves(const TessellationRequest& made, TessellationRequest asked) {
    asked.curvature |= made.curvature;
    asked.attributes |= made.attributes;
    return made == asked;
  }

  std::optional<Made> made_;
};

}  // namespace

struct Growth::Parts {
  Run run;
  Look look;
  Progress progress;
  ShapeFile file = {};  ///< without its mesh, which the run has
  TessellationCache tessellations = {};

  Tessellation tessellation(const CoatFields& fields, const Look& as_asked, const Paint& paint) {
    const Tessellation& made = tessellations.of(run, tessellation_request(as_asked, paint));
    return may_be_cut(fields, as_asked) ? cut_along_layers(made, paint) : made;
  }
};

TriangleMesh grow(const TriangleMesh& shape, const Recipe& recipe, const Progress& progress) {
  Growth growth(shape, recipe, progress);
  while (!growth.done()) growth.advance(1);
  return growth.dress();
}

Growth::Growth(TriangleMesh shape, const Recipe& recipe, const Progress& progress)
    : parts_(std::make_unique<Parts>(
          Parts{Run(make_program(recipe, std::move(shape)), progress), shown_look(recipe), progress})) {}

Growth::Growth(Grid grid, const Recipe& recipe, const Progress& progress)
    : parts_(std::make_unique<Parts>(
          Parts{Run(make_program(recipe, std::move(grid)), progress), shown_look(recipe), progress})) {}

namespace {

void take(const OwnRates& own, Program& program) {
  if (!own.rates) return;
  std::vector<std::string> names;
  for (const StageProgram& stage : program.stages) names.push_back(stage.name);
  const std::string& wanted = own.stage.empty() ? names.back() : own.stage;
  const auto found = std::ranges::find(names, wanted);
  if (found == names.end()) throw Error(Fault::usage, unknown_name("stage", wanted, names));
  program.stages[static_cast<std::size_t>(found - names.begin())].own_rates = own.rates;
}

/// A function costs a call: it gets a stepper that makes few of them, for many samples each.
Recipe suited_to(const OwnRates& own, Recipe recipe) {
  for (Stage& stage : recipe.stages)
    if (own.rates && stage.stepper.value.empty()) stage.stepper.value = sbdf2.name;
  return recipe;
}

/// The run, and the file without what the run has of it.
std::pair<Run, ShapeFile> run_on(ShapeFile file, const Recipe& recipe, const Progress& progress, const OwnRates& own) {
  const Plan planned = plan(suited_to(own, recipe));
  std::vector<Texture> images = read_images(recipe.textures);
  Program program = bind_plan(planned, file, std::move(images));
  take(own, program);
  return {Run(std::move(program), progress), std::move(file)};
}

}  // namespace

Growth::Growth(ShapeFile shape, const Recipe& recipe, const Progress& progress, const OwnRates& own) {
  auto [run, file] = run_on(std::move(shape), recipe, progress, own);
  parts_ = std::make_unique<Parts>(Parts{std::move(run), shown_look(recipe), progress, std::move(file)});
}

Growth::~Growth() = default;
Growth::Growth(Growth&&) noexcept = default;
Growth& Growth::operator=(Growth&&) noexcept = default;

bool Growth::done() const { return parts_->run.done(); }

double Growth::fraction() const { return parts_->run.fraction(); }

void Growth::advance(std::int64_t steps) {
  Run& run = parts_->run;
  for (std::int64_t k = 0; k < steps && !run.done(); ++k) {
    report(parts_->progress, "growing", run.fraction());
    parts_->tessellations.clear();
    run.advance(1);
  }
  if (run.summary().status == RunStatus::failed) throw Error(Fault::numerics, run.summary().message);
}

Growth::StagePlace Growth::stage() const {
  const Run& run = parts_->run;
  return {run.stage(), run.program().stages.size(), run.stage_program().name};
}

const RunSummary& Growth::summary() const { return parts_->run.summary(); }

bool Growth::uniform() const { return parts_->run.uniform(); }

std::string Growth::why_uniform() const { return uniform() ? parts_->run.why_uniform() : ""; }

const std::vector<std::string>& Growth::warnings() const { return parts_->run.warnings(); }

TriangleMesh Growth::dress() const { return dress(parts_->look); }

TriangleMesh Growth::dress(const Look& look) const {
  const CoatFields fields = parts_->run.fields();
  const Paint paint = resolve_paint(look, fields.species);
  TriangleMesh coat = pelage::dress(parts_->tessellation(fields, look, paint), paint, fields.uniform);
  if (!look.keep_shape || fields.shape->triangles.empty()) return coat;
  std::vector<Finding> none;
  return triangulate(kept_shape(own_form(*fields.shape), coat, paint), none).mesh;
}

Grid Growth::dress_grid() const {
  const CoatFields fields = parts_->run.fields();
  const Grid* grid = as<Grid>(fields.nodes);
  if (!grid) throw Error(Fault::usage, "the coat has not grown on a grid");
  return on_grid(*grid, dress());
}

std::vector<Growth::Field> Growth::fields() const {
  const CoatFields fields = parts_->run.fields();
  const Look& look = parts_->look;
  const Tessellation t = parts_->tessellation(fields, look, resolve_paint(look, fields.species));
  std::vector<Field> named;
  for (std::size_t i = 0; i < fields.species.size(); ++i) named.push_back({fields.species[i], t.samples.fields[i]});
  return named;
}

PolygonMesh Growth::dress_in_file() const {
  Look look = parts_->look;
  look.keep_shape = true;
  const CoatFields fields = parts_->run.fields();
  const Paint paint = resolve_paint(look, fields.species);
  const TriangleMesh coat = pelage::dress(parts_->tessellation(fields, look, paint), paint, fields.uniform);
  return kept_shape(parts_->file.source ? *parts_->file.source : own_form(*fields.shape), coat, paint);
}

TexturedMesh Growth::bake(int size) const {
  return textured_coat(parts_->run.fields(), parts_->file, parts_->look, size, parts_->progress);
}

TriangleMesh Growth::nodes() const {
  const Run& run = parts_->run;
  const World& world = run.world();
  PlaceGeometry places = run.space().geometry(SampleRule::vertices, false);
  TriangleMesh mesh{std::move(places.position), {}, {}};
  if (world.hierarchy())
    mesh.triangles = world.topology().triangles;
  else if (run.program().shape && run.program().shape->points.size() == mesh.points.size())
    mesh.triangles = run.program().shape->triangles;
  Attribute normal{"normal", 3, Domain::vertex, {}};
  for (const Point& n : places.normal) normal.values.insert(normal.values.end(), n.begin(), n.end());
  if (!normal.values.empty()) mesh.set(std::move(normal));
  return mesh;
}

std::vector<std::string> Growth::species() const {
  const Model& model = parts_->run.stage_program().model;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.species_count(); ++i) names.push_back(model.species_name(i));
  return names;
}

std::size_t Growth::species_number(const std::string& name) const {
  const std::vector<std::string> names = species();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw Error(Fault::usage, unknown_name("species", name, names));
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<double> Growth::values(const std::string& species) const {
  const Run& run = parts_->run;
  const Vector values = run.space().node_values() * run.coefficients()[species_number(species)];
  return {values.begin(), values.end()};
}

void Growth::set_values(const std::string& species, const std::vector<double>& values) {
  Run& run = parts_->run;
  const std::size_t i = species_number(species);
  if (std::ssize(values) != run.space().unknowns())
    throw Error(Fault::usage, std::to_string(values.size()) + " values for " + species + "; there are " +
                                  std::to_string(run.space().unknowns()) + " nodes");
  if (!std::ranges::all_of(values, [](double x) { return std::isfinite(x); }))
    throw Error(Fault::usage, "values of " + species + " have to be finite");
  run.set_values(i, Eigen::Map<const Vector>(values.data(), std::ssize(values)));
  parts_->tessellations.clear();
}

std::string Growth::checkpoint() const { return parts_->run.checkpoint(); }

void Growth::restore(const std::string& bytes) {
  parts_->run.restore(bytes);
  parts_->tessellations.clear();
}

}  // namespace pelage
