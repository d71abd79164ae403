#include "studio/live_coat.h"

#include <utility>

#include "base/suggest.h"
#include "catalog/bind.h"
#include "catalog/plan.h"
#include "catalog/textured_coat.h"
#include "look/cut_tessellation.h"
#include "look/dress.h"
#include "pelage/error.h"
#include "shape/vectors.h"
#include "studio/catalogue.h"

namespace pelage {

namespace {

Program bound(const ShapeFile& shape, const Recipe& recipe) {
  ShapeFile own = shape;
  return bind_plan(plan(recipe), own);
}

/// Whether the nodes of one program are those of the other, so that they need not be laid again.
bool same_place(const Program& a, const Program& b) {
  return !a.nodes && !b.nodes && !a.motion.any() && !b.motion.any() && a.method == b.method &&
         a.interpolate == b.interpolate && a.creases.any() == b.creases.any() && a.edge == b.edge &&
         a.edges == b.edges && a.shape->points == b.shape->points && a.shape->triangles == b.shape->triangles;
}

Run begun(Program program, const Progress& progress, const Run* before) {
  if (!before || !same_place(program, before->program()) || program.creases.any())
    return Run(std::move(program), progress);
  return Run(std::make_shared<const Program>(std::move(program)), before->world().unmoved(), progress);
}

const char* words_of(RunStatus status) {
  switch (status) {
    case RunStatus::time_reached:
      return "time reached";
    case RunStatus::steps_reached:
      return "steps reached";
    case RunStatus::stationary:
      return "at rest";
    case RunStatus::failed:
      return "failed";
    case RunStatus::running:
      break;
  }
  return "running";
}

Header species_of(const Model& model) {
  Header list = Header::array();
  for (std::size_t i = 0; i < model.species_count(); ++i) list.push_back(model.species_name(i));
  return list;
}

Header stages_of(const Program& program) {
  Header list = Header::array();
  for (const StageProgram& s : program.stages)
    list.push_back({{"name", s.name},
                    {"model", s.model_name},
                    {"size", s.size},
                    {"species", species_of(s.model)},
                    {"parameters", described(s.model.parameters())},
                    {"anisotropic", s.model.anisotropic()}});
  return list;
}

Header ranges_of(const Run& run) {
  Header list = Header::array();
  for (std::size_t i = 0; i < run.coefficients().size(); ++i)
    list.push_back({{"species", run.stage_program().model.species_name(i)},
                    {"low", minimum(run.coefficients()[i])},
                    {"high", maximum(run.coefficients()[i])}});
  return list;
}

double mean_edge(const NodeView& view) {
  double sum = 0;
  for (const Triangle& t : view.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += length(difference(view.samples.position[static_cast<std::size_t>(t[k])],
                               view.samples.position[static_cast<std::size_t>(t[(k + 1) % 3])]));
  return view.triangles.empty() ? 0 : sum / (3 * static_cast<double>(view.triangles.size()));
}

std::vector<float> flat_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

LiveCoat::LiveCoat(const ShapeFile& shape, const Recipe& recipe, const Progress& progress, const LiveCoat* before)
    : run_(begun(bound(shape, recipe), progress, before ? &before->run_ : nullptr)), recipe_(recipe) {
  const bool sound = before && before->run_.summary().status != RunStatus::failed;
  kept_ = sound && run_.take_over(before->run_);
  follow_stage();
}

/// A look tells of the last stage; those before it show themselves.
Look LiveCoat::look_now() const {
  if (run_.stage() + 1 == recipe_.stages.size()) return shown_look(recipe_);
  Recipe so_far = recipe_;
  so_far.stages.resize(run_.stage() + 1);
  so_far.look = {};
  return shown_look(so_far);
}

void LiveCoat::follow_stage() {
  Paint paint = resolve_paint(look_now(), run_.fields().species);
  view_ = view_nodes(run_, paint);
  paint_ = std::move(paint);
}

void LiveCoat::advance(const std::function<bool()>& more) {
  if (run_.done()) run_.go_on();
  const std::size_t stage = run_.stage();
  do run_.advance(1);
  while (more() && !run_.done());
  if (run_.summary().status == RunStatus::failed) throw Error(Fault::numerics, run_.summary().message);
  if (run_.stage() != stage)
    follow_stage();
  else
    refresh(view_, run_, paint_);
}

std::size_t LiveCoat::species_number(const std::string& name) const {
  const Model& model = run_.stage_program().model;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.species_count(); ++i) names.push_back(model.species_name(i));
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw Error(Fault::usage, unknown_name("species", name, names));
  return static_cast<std::size_t>(found - names.begin());
}

void LiveCoat::paint(const std::string& species, double value, const BrushStroke& stroke) {
  const std::size_t i = species_number(species);
  const PlaceGeometry nodes = run_.space().geometry(SampleRule::vertices, false);
  const std::vector<double> share = stroke_shares(stroke, nodes.position, nodes.normal);
  std::vector<Vector> fields = run_.coefficients();
  Vector& u = fields[i];
  for (Eigen::Index v = 0; v < u.size(); ++v) u[v] += share[static_cast<std::size_t>(v)] * (value - u[v]);
  run_.set_coefficients(std::move(fields));
  refresh(view_, run_, paint_);
}

void LiveCoat::show(const Recipe& recipe) {
  const Look before = std::exchange(recipe_.look, recipe.look);
  try {
    follow_stage();
  } catch (...) {
    recipe_.look = before;
    throw;
  }
}

void LiveCoat::restore(const std::string& checkpoint) {
  run_.restore(checkpoint);
  follow_stage();
}

void LiveCoat::add_colors(Message& message) const {
  message.blocks.push_back({"colors", view_colors(view_, paint_, run_.uniform_species())});
}

void LiveCoat::add_geometry(Message& message) const {
  message.blocks.push_back({"positions", as_floats(view_.samples.position)});
  message.blocks.push_back({"normals", as_floats(view_.samples.normal)});
}

Message LiveCoat::colors() const {
  Message m;
  add_colors(m);
  return m;
}

Message LiveCoat::state() const {
  const RunSummary& summary = run_.summary();
  Message m;
  m.header = {{"running", !run_.done()},    {"status", words_of(summary.status)},
              {"message", summary.message}, {"stage", run_.stage()},
              {"time", summary.time},       {"steps", summary.steps},
              {"change", summary.change},   {"fraction", run_.fraction()},
              {"uniform", run_.uniform()},  {"why_uniform", run_.uniform() && run_.done() ? run_.why_uniform() : ""},
              {"range", ranges_of(run_)}};
  if (view_.moves) add_geometry(m);
  add_colors(m);
  return m;
}

Message LiveCoat::described() const {
  Message m = state();
  if (!view_.moves) add_geometry(m);
  m.blocks.push_back({"triangles", as_indices(view_.triangles)});
  m.header["stages"] = stages_of(run_.program());
  m.header["nodes"] = view_.samples.size();
  m.header["node_spacing"] = mean_edge(view_);
  m.header["warnings"] = run_.warnings();
  m.header["kept"] = kept_;
  return m;
}

Message LiveCoat::field(const std::string& species) const {
  const std::size_t first = view_.samples.fields.size() - run_.coefficients().size();
  Message m;
  m.blocks.push_back({"values", flat_floats(view_.samples.fields[first + species_number(species)])});
  return m;
}

Message LiveCoat::sampled(const Point& at) const {
  const std::vector<Point>& nodes = view_.samples.position;
  const auto nearest =
      std::ranges::min_element(nodes, {}, [&](const Point& p) { return dot(difference(p, at), difference(p, at)); });
  const auto node = static_cast<std::size_t>(nearest - nodes.begin());
  Header values = Header::array();
  for (std::size_t i = 0; i < paint_.species.size(); ++i)
    values.push_back({{"species", paint_.species[i]}, {"value", view_.samples.fields[i][node]}});
  Message m;
  m.header = {{"node", node}, {"position", nodes[node]}, {"values", values}};
  return m;
}

TriangleMesh LiveCoat::dressed() const { return dress(run_.fields(), look_now()); }

std::string LiveCoat::baked(int size, const SaveOptions& options, const Progress& progress) const {
  const TexturedMesh baked = textured_coat(run_.fields(), {}, look_now(), size, progress);
  SaveOptions textured = options;
  textured.textures = {baked.maps};
  textured.repeat = baked.repeat;
  return mesh_bytes(baked.mesh, ".glb", textured);
}

Message LiveCoat::fine() const {
  const Tessellation t = tessellate_for(run_.fields(), look_now(), paint_);
  Message m;
  m.blocks = {{"positions", as_floats(t.samples.position)},
              {"normals", as_floats(t.samples.normal)},
              {"triangles", as_indices(t.triangles)},
              {"colors", as_bytes(pelage::paint(t.samples, make_palette(paint_, t.samples, run_.uniform_species())))}};
  return m;
}

}  // namespace pelage
