#include "react/kinetics.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "react/place_values.h"

namespace pelage {

namespace {

bool depends_only_on(const Graph& graph, NodeId id, Dependence what) { return graph[id].dependence == what; }

/// The largest sub-expressions of the roots that depend on `what` and on nothing else, in order of number.
std::vector<NodeId> maximal(const Graph& graph, std::span<const NodeId> roots, Dependence what) {
  std::set<NodeId> result;
  const auto look = [&](NodeId id) {
    if (id >= 0 && depends_only_on(graph, id, what)) result.insert(id);
  };
  for (const NodeId root : roots) look(root);
  for (const NodeId id : reachable(graph, roots)) {
    const Node& node = graph[id];
    if (depends_only_on(graph, id, what)) continue;
    for (int k = 0; k < arity(node.op); ++k) look(node.in[static_cast<std::size_t>(k)]);
  }
  return {result.begin(), result.end()};
}

std::vector<NodeId> join(std::vector<NodeId> a, const std::vector<NodeId>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<double*> join(SpeciesOutput a, SpeciesOutput b) {
  std::vector<double*> both(a.begin(), a.end());
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

/// One value per sample, or one for all.
void spread(const std::vector<double>& values, std::span<double> out) {
  if (values.size() == out.size() && out.size() != 1)
    std::ranges::copy(values, out.begin());
  else
    std::ranges::fill(out, values.front());
}

}  // namespace

/// Turns the equations of a model into programs over the samples.
class KineticsBuilder {
 public:
  KineticsBuilder(Kinetics& kinetics, const Model& model, const Places& places, std::uint64_t seed)
      : kinetics_(kinetics), graph_(kinetics.graph_), equations_(model.equations()), places_(places), seed_(seed) {
    graph_ = equations_.graph;
    kinetics.size_ = places.positions.size();
    kinetics.species_count_ = equations_.species.size();
    kinetics.gradient_count_ = equations_.gradients.size();
  }

  void build(Kinetics::Parts parts) {
    const Equations& e = equations_;
    if (parts == Kinetics::Parts::all) add_reaction();
    kinetics_.diffusion_ = program(join(e.prefactor, e.diffusion), {});
    std::vector<NodeId> entries;
    for (const auto& tensor : e.tensor)
      if (tensor) entries.insert(entries.end(), tensor->begin(), tensor->end());
    kinetics_.tensors_ = program(entries, {});
    std::vector<NodeId> coefficients;
    for (const Flux& flux : e.fluxes) coefficients.push_back(flux.coefficient);
    kinetics_.fluxes_ = program(coefficients, {});
    for (const auto& a : e.anisotropy) {
      auto& fields = kinetics_.anisotropy_.emplace_back();
      if (a) fields = {place_field(a->theta), place_field(a->a1), place_field(a->a2)};
    }
  }

 private:
  void add_reaction() {
    const Equations& e = equations_;
    kinetics_.rates_ = program(e.rate, e.gradients);
    kinetics_.split_ = program(join(e.c2, e.c3), e.gradients);
    kinetics_.jacobian_ = program(e.jacobian, e.gradients);
  }

  /// The concentration as the reaction sees it.
  NodeId clamped(NodeId species) {
    const auto i = static_cast<std::size_t>(graph_.symbol_of(species).index);
    if (std::isfinite(equations_.lower[i]))
      species = graph_.make(Op::maximum, species, graph_.constant(equations_.lower[i]));
    if (std::isfinite(equations_.upper[i]))
      species = graph_.make(Op::minimum, species, graph_.constant(equations_.upper[i]));
    return species;
  }

  Kinetics::Program program(const std::vector<NodeId>& expressions, const std::vector<NodeId>& gradients) {
    std::vector<NodeId> roots = rewrite(graph_, expressions, [&](NodeId id) -> std::optional<NodeId> {
      if (graph_[id].op != Op::symbol || graph_.symbol_of(id).kind != Symbol::Kind::species) return std::nullopt;
      return clamped(id);
    });
    roots = expand_powers(graph_, roots);
    Kinetics::Program result;
    const std::vector<NodeId> of_place = maximal(graph_, roots, on_place);
    result.fields = fields(of_place);
    result.time_expressions = maximal(graph_, roots, on_time);
    result.tape = Tape(graph_, roots, join(join(equations_.species, gradients), of_place), result.time_expressions);
    return result;
  }

  /// Numbers of the fields that hold the given expressions; those not yet known are evaluated.
  std::vector<std::size_t> fields(const std::vector<NodeId>& expressions) {
    std::vector<NodeId> missing;
    for (const NodeId id : expressions)
      if (!field_of_.contains(id)) missing.push_back(id);
    std::vector<std::vector<double>> values = evaluate_places(graph_, missing, places_, seed_);
    for (std::size_t k = 0; k < missing.size(); ++k) {
      field_of_[missing[k]] = kinetics_.fields_.size();
      kinetics_.fields_.push_back(std::move(values[k]));
    }
    std::vector<std::size_t> numbers;
    for (const NodeId id : expressions) numbers.push_back(field_of_.at(id));
    return numbers;
  }

  std::vector<double> place_field(NodeId expression) { return evaluate_place(graph_, expression, places_, seed_); }

  Kinetics& kinetics_;
  Graph& graph_;
  const Equations& equations_;
  const Places& places_;
  const std::uint64_t seed_;
  std::map<NodeId, std::size_t> field_of_;
};

Kinetics::Kinetics(const Model& model, const Places& places, std::uint64_t seed, Parts parts) {
  KineticsBuilder(*this, model, places, seed).build(parts);
}

void Kinetics::run(const Program& program, SpeciesValues u, double t, std::size_t begin, std::size_t end,
                   SpeciesOutput out) const {
  assert(u.size() <= input_count() && end <= size_);
  std::vector<const double*> inputs(u.begin(), u.end());
  for (const std::size_t field : program.fields) inputs.push_back(fields_[field].data());
  program.tape.run(inputs, scalars(program, t), begin, end, out);
}

std::vector<double> Kinetics::scalars(const Program& program, double t) const {
  if (program.time_expressions.empty()) return {};
  return evaluate(graph_, program.time_expressions, [t](const Symbol&) { return t; });
}

const std::vector<std::vector<float>>& Kinetics::float_fields(const Program& program) const {
  FloatFields& single = *program.single;
  std::call_once(single.once, [&] {
    for (const std::size_t k : program.fields) single.fields.emplace_back(fields_[k].begin(), fields_[k].end());
  });
  return single.fields;
}

Kinetics::FloatFunction Kinetics::float_function(const Program& program, double t) const {
  const std::vector<double> values = scalars(program, t);
  return [this, &program, single = std::vector<float>(values.begin(), values.end())](
             std::span<const float* const> u, std::size_t first, std::size_t count, std::span<float* const> out) {
    run(program, single, u, first, count, out);
  };
}

void Kinetics::run(const Program& program, std::span<const float> scalars, std::span<const float* const> u,
                   std::size_t first, std::size_t count, std::span<float* const> out) const {
  assert(u.size() == input_count() && first + count <= size_);
  std::array<const float*, 16> few;  // an allocation would cost as much as a block of samples
  std::vector<const float*> many;
  const auto& fields = float_fields(program);
  const std::size_t inputs = u.size() + fields.size();
  if (inputs > few.size()) many.resize(inputs);
  const float** in = many.empty() ? few.data() : many.data();
  std::ranges::copy(u, in);
  for (std::size_t k = 0; k < fields.size(); ++k) in[u.size() + k] = fields[k].data() + first;
  program.tape.run({in, inputs}, scalars, count, out);
}

void Kinetics::rates(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const {
  run(rates_, u, t, begin, end, out);
}

void Kinetics::split(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput c2,
                     SpeciesOutput c3) const {
  run(split_, u, t, begin, end, join(c2, c3));
}

void Kinetics::jacobian(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const {
  run(jacobian_, u, t, begin, end, out);
}

void Kinetics::diffusion(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput c0,
                         SpeciesOutput c1) const {
  run(diffusion_, u, t, begin, end, join(c0, c1));
}

void Kinetics::tensors(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const {
  run(tensors_, u, t, begin, end, out);
}

void Kinetics::fluxes(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const {
  run(fluxes_, u, t, begin, end, out);
}

Kinetics::TensorField Kinetics::anisotropy(std::size_t i) const {
  TensorField field;
  const auto& [theta, a1, a2] = anisotropy_[i];
  const auto fill = [&](const std::vector<double>& values, std::vector<double>& out) {
    out.resize(size_);
    spread(values, out);
  };
  fill(theta, field.theta);
  fill(a1, field.a1);
  fill(a2, field.a2);
  return field;
}

namespace {

/// An expression of the place alone, one value per place.
std::vector<double> values_at(const Model& model, NodeId expression, const Places& places, std::uint64_t seed) {
  Graph graph = model.equations().graph;
  std::vector<double> values = evaluate_place(graph, expression, places, seed);
  if (values.size() == 1) values.resize(places.positions.size(), values.front());
  return values;
}

std::vector<double> bounded(const Model& model, std::size_t i, std::vector<double> values) {
  for (double& value : values) value = std::min(std::max(value, model.lower(i)), model.upper(i));
  return values;
}

}  // namespace

std::vector<double> initial_values(const Model& model, std::size_t i, const Places& places, std::uint64_t seed) {
  return bounded(model, i, values_at(model, model.equations().initial[i], places, seed));
}

std::vector<double> pinned_values(const Model& model, std::size_t i, const Places& places, std::uint64_t seed) {
  return bounded(model, i, values_at(model, model.equations().pin[i].value(), places, seed));
}

std::vector<double> mask_values(const Model& model, const Places& places, std::uint64_t seed) {
  return values_at(model, *model.equations().mask, places, seed);
}

}  // namespace pelage
