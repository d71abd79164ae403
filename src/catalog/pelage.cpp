#include "pelage/pelage.h"

#include "catalog/bind.h"
#include "catalog/recipes.h"
#include "io/read_shape.h"
#include "io/write_mesh.h"
#include "look/dress.h"
#include "run/run.h"

namespace pelage {

struct Growth::Parts {
  Run run;
  Look look;
};

TriangleMesh load_shape(const std::string& path_or_builtin) { return read_shape(path_or_builtin).mesh; }

Recipe recipe(const std::string& name_or_path) { return load_recipe(name_or_path); }

Growth::Growth(TriangleMesh shape, const Recipe& recipe)
    : parts_(std::make_unique<Parts>(Parts{Run(make_program(recipe, std::move(shape))), recipe.look})) {}

Growth::~Growth() = default;
Growth::Growth(Growth&&) noexcept = default;
Growth& Growth::operator=(Growth&&) noexcept = default;

bool Growth::done() const { return parts_->run.done(); }

double Growth::fraction() const { return parts_->run.fraction(); }

void Growth::advance(std::int64_t steps) {
  const RunSummary& summary = parts_->run.advance(steps);
  if (summary.status == RunStatus::failed) throw Error(Fault::numerics, summary.message);
}

TriangleMesh Growth::dress() const { return pelage::dress(parts_->run.fields(), parts_->look); }

void save(const TriangleMesh& mesh, const std::string& path) { write_mesh(mesh, path); }

}  // namespace pelage
