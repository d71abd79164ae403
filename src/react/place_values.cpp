#include "react/place_values.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/suggest.h"

namespace pelage {

namespace {

double gaussian(std::uint64_t key) {  // Box and Muller 1958; 1 - u is never 0
  constexpr double two_pi = 6.28318530717958647692;
  return std::sqrt(-2 * std::log(1 - uniform(key, 0))) * std::cos(two_pi * uniform(key, 1));
}

template <class Value>
std::vector<double> tabulate(std::size_t size, Value&& value) {
  std::vector<double> result(size);
  parallel_for(size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[i] = value(i);
  });
  return result;
}

void require(bool present, const std::string& what, const Symbol& symbol) {
  if (!present)
    throw Error(Fault::usage, "the model uses " + what + ", which this surface does not have", symbol.where);
}

std::span<const double> attribute(const Symbol& symbol, const Places& places) {
  const auto found = places.attributes.find(symbol.name);
  if (found != places.attributes.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, values] : places.attributes) names.push_back(name);
  require_attribute(symbol, names);
  return places.attributes.at(*matching_name(symbol.name, names));
}

}  // namespace

void require_attribute(const Symbol& symbol, const std::vector<std::string>& names) {
  if (matching_name(symbol.name, names)) return;
  const std::string hint = did_you_mean(symbol.name, names);
  if (symbol.name.find('.') != std::string::npos)
    throw Error(Fault::usage,
                "there is no field \"" + symbol.name + "\" (STAGE.SPECIES of an earlier stage)" +
                    (hint.empty() ? "" : "; " + hint),
                symbol.where);
  throw Error(Fault::usage,
              "the mesh has no vertex attribute \"" + symbol.name + "\"; " +
                  (hint.empty() ? "it has " + (names.empty() ? "none" : join_names(names)) : hint),
              symbol.where);
}

namespace {

std::vector<double> random_values(const Symbol& symbol, const Places& places, std::uint64_t seed) {
  for (const DrawnField& drawn : places.drawn)
    if (drawn.symbol == symbol) return drawn.values;
  const std::uint64_t stream = hash(seed, symbol.stream);
  return tabulate(places.positions.size(), [&](std::size_t i) {
    Point p = places.positions[i];
    for (std::size_t k = 0; k < 3; ++k) p[k] -= places.origin[k];
    if (symbol.kind == Symbol::Kind::noise)
      return smooth_noise(p, symbol.length * places.length_unit, stream, places.period);
    const std::uint64_t here = place_seed(p, places.length_unit, stream);
    return symbol.kind == Symbol::Kind::uniform ? uniform(here, 0) : gaussian(here);
  });
}

std::vector<double> box_positions(const Places& places, std::size_t component) {
  const Box box = places.box ? *places.box : box_of(places.positions);
  const double low = box.low[component], high = box.high[component];
  return tabulate(places.positions.size(), [&](std::size_t i) {
    return high > low ? (2 * places.positions[i][component] - low - high) / (high - low) : 0;
  });
}

}  // namespace

std::vector<double> place_values(const Symbol& symbol, const Places& places, std::uint64_t seed) {
  const std::size_t size = places.positions.size();
  const auto component = static_cast<std::size_t>(symbol.index);
  switch (symbol.kind) {
    case Symbol::Kind::position:
      return tabulate(size, [&](std::size_t i) { return places.positions[i][component]; });
    case Symbol::Kind::box_position:
      return box_positions(places, component);
    case Symbol::Kind::normal_vector:
      require(places.normals.size() == size, "normals", symbol);
      return tabulate(size, [&](std::size_t i) { return places.normals[i][component]; });
    case Symbol::Kind::curvature: {
      const auto values = symbol.index == 0 ? places.k1 : places.k2;
      require(values.size() == size, "curvatures", symbol);
      return {values.begin(), values.end()};
    }
    case Symbol::Kind::attribute: {
      const auto values = attribute(symbol, places);
      require(values.size() == size, "attribute \"" + symbol.name + "\"", symbol);
      return {values.begin(), values.end()};
    }
    case Symbol::Kind::mask:
      require(places.mask.size() == size, "a mask", symbol);
      return {places.mask.begin(), places.mask.end()};
    default:
      return random_values(symbol, places, seed);
  }
}

std::vector<DrawnField> draw_random_fields(const std::vector<Symbol>& symbols, const Places& places,
                                           std::uint64_t seed) {
  std::vector<DrawnField> fields;
  for (const Symbol& s : symbols)
    if (s.kind == Symbol::Kind::uniform || s.kind == Symbol::Kind::gaussian || s.kind == Symbol::Kind::noise)
      fields.push_back({s, random_values(s, places, seed)});
  return fields;
}

std::vector<std::vector<double>> evaluate_places(const Graph& graph, const std::vector<NodeId>& expressions,
                                                 const Places& places, std::uint64_t seed) {
  const std::size_t size = places.positions.size();
  std::vector<NodeId> symbols;
  std::vector<std::vector<double>> inputs, outputs(expressions.size(), std::vector<double>(size));
  std::vector<const double*> in;
  std::vector<double*> out;
  for (const NodeId id : reachable(graph, expressions)) {
    if (graph[id].op != Op::symbol) continue;
    symbols.push_back(id);
    inputs.push_back(place_values(graph.symbol_of(id), places, seed));
  }
  for (const auto& input : inputs) in.push_back(input.data());
  for (auto& output : outputs) out.push_back(output.data());
  const Tape tape(graph, expressions, symbols, {});
  parallel_for(size, [&](std::size_t begin, std::size_t end) { tape.run(in, {}, begin, end, out); });
  return outputs;
}

std::vector<double> evaluate_place(Graph& graph, NodeId expression, const Places& places, std::uint64_t seed) {
  const std::vector<NodeId> root = expand_powers(graph, std::vector<NodeId>{expression});
  if (!graph[root[0]].dependence) return {*graph.constant_value(root[0])};
  return std::move(evaluate_places(graph, root, places, seed)[0]);
}

std::vector<Symbol> place_symbols(const Graph& graph, const std::vector<NodeId>& expressions) {
  std::vector<Symbol> symbols;
  for (const NodeId id : reachable(graph, expressions))
    if (graph[id].op == Op::symbol && graph[id].dependence == on_place) symbols.push_back(graph.symbol_of(id));
  return symbols;
}

std::vector<Symbol> place_symbols(const Model& model) {
  const Equations& e = model.equations();
  std::vector<NodeId> roots = e.rate;
  for (const auto* expressions : {&e.prefactor, &e.diffusion, &e.initial})
    roots.insert(roots.end(), expressions->begin(), expressions->end());
  for (const Flux& flux : e.fluxes) roots.push_back(flux.coefficient);
  for (const auto& a : e.anisotropy)
    if (a) roots.insert(roots.end(), {a->theta, a->a1, a->a2});
  for (const auto& tensor : e.tensor)
    if (tensor) roots.insert(roots.end(), tensor->begin(), tensor->end());
  for (const auto& pin : e.pin)
    if (pin) roots.push_back(*pin);
  if (e.mask) roots.push_back(*e.mask);
  return place_symbols(e.graph, roots);
}

}  // namespace pelage
