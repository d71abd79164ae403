#include "run/borders.h"

#include <algorithm>

#include "base/box.h"
#include "run/program.h"

namespace pelage {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Borders::Borders(const StageProgram& stage, const Space& space) : stage_(&stage), unknowns_(space.unknowns()) {
  const PlaceGeometry places = space.geometry(SampleRule::vertices, false);
  const Box box = box_of(places.position);
  for (const BorderCondition& c : stage.borders) {
    Side& side = sides_.emplace_back(Side{&c, space.border(c.side), {}, {}});
    for (const Index v : side.border.node) {
      side.position.push_back(places.position[at(v)]);
      side.normal.push_back(places.normal[at(v)]);
    }
    side.position.insert(side.position.end(), {box.low, box.high});
    side.normal.resize(side.position.size());
  }
}

bool Borders::gives_values(std::size_t species) const {
  return std::ranges::any_of(stage_->borders, [&](const auto& c) { return c.species == species && c.value; });
}

bool Borders::any_inflow() const {
  return std::ranges::any_of(stage_->borders, [](const auto& c) { return !c.value; });
}

std::shared_ptr<const Held> Borders::held(std::size_t species, const Held* held) const {
  auto result = std::make_shared<Held>(held ? *held : Held(at(unknowns_), 0));
  for (const Side& side : sides_)
    if (side.condition->species == species && side.condition->value)
      for (const Index v : side.border.node) (*result)[at(v)] = 1;
  return result;
}

std::vector<double> Borders::values(const Side& side, const BorderFormula& formula, double t) const {
  const std::vector<double> time(side.position.size(), t);
  Places places;
  places.positions = side.position;
  places.normals = side.normal;
  places.attributes["t"] = time;
  places.length_unit = stage_->length_unit;
  places.origin = stage_->origin;
  places.period = stage_->period;
  std::vector<double> values = formula.formula.at(places, stage_->seed);
  values.resize(side.border.node.size());
  return values;
}

void Borders::set_values(std::size_t species, double t, Vector& u) const {
  for (const Side& side : sides_) {
    if (side.condition->species != species || !side.condition->value) continue;
    const std::vector<double> value = values(side, *side.condition->value, t);
    for (std::size_t k = 0; k < value.size(); ++k) u[side.border.node[k]] = value[k];
  }
}

/// Model length / time is length_unit times as much in the world.
void Borders::add_inflows(const std::vector<Vector>& u, double t, std::vector<Vector>& loads) const {
  for (const Side& side : sides_) {
    const BorderCondition& c = *side.condition;
    if (c.value) continue;
    Vector& load = loads[c.species];
    if (load.size() == 0) load = Vector::Zero(unknowns_);
    const std::vector<double> none(side.border.node.size(), 0.0);
    const std::vector<double> flux = c.flux ? values(side, *c.flux, t) : none;
    const std::vector<double> loss = c.loss ? values(side, *c.loss, t) : none;
    Vector inflow(static_cast<Eigen::Index>(none.size()));
    for (std::size_t k = 0; k < none.size(); ++k)
      inflow[static_cast<Eigen::Index>(k)] = flux[k] - loss[k] * u[c.species][side.border.node[k]];
    const Vector loads_there = side.border.mass * inflow;
    for (std::size_t k = 0; k < none.size(); ++k)
      load[side.border.node[k]] += stage_->length_unit * loads_there[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace pelage
