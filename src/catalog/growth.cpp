#include <optional>

#include "base/report.h"
#include "catalog/bind.h"
#include "look/cut_tessellation.h"
#include "look/dress.h"
#include "pelage/grow.h"
#include "run/run.h"

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
  return pelage::dress(parts_->tessellation(fields, look, paint), paint, fields.uniform);
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

std::string Growth::checkpoint() const { return parts_->run.checkpoint(); }

void Growth::restore(const std::string& bytes) {
  parts_->run.restore(bytes);
  parts_->tessellations.clear();
}

}  // namespace pelage
