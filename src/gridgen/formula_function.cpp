#include "gridgen/formula_function.h"

#include <algorithm>

#include "base/suggest.h"
#include "react/derivative.h"
#include "react/place_values.h"

namespace pelage {

namespace {

/// Variables are attributes of the place, under their own names.
NodeId variable_node(Graph& graph, const std::string& name, const Location& where) {
  Symbol symbol{Symbol::Kind::attribute};
  symbol.name = name;
  symbol.where = where;
  return graph.symbol(symbol);
}

}  // namespace

FormulaFunction::FormulaFunction(const Formula& formula, const std::vector<std::string>& variables,
                                 const std::map<std::string, double>& numbers)
    : where_(formula.where), variables_(variables) {
  Scope scope;
  std::vector<NodeId> nodes;
  for (const auto& [name, value] : numbers) scope.names[name] = graph_.constant(value);
  for (const std::string& name : variables) {
    nodes.push_back(variable_node(graph_, name, formula.where));
    scope.names[name] = nodes.back();
  }
  const NodeId root = parse_formula(graph_, formula, scope, "grid");
  for (const NodeId id : reachable(graph_, std::vector<NodeId>{root}))
    if (graph_[id].op == Op::symbol && std::ranges::find(nodes, id) == nodes.end())
      throw Error(Fault::usage, "this formula may depend on " + join_names(variables) + " only", formula.where);
  roots_ = {root};
  for (const NodeId node : nodes) roots_.push_back(derivative(graph_, std::vector<NodeId>{root}, node)[0]);
  roots_ = expand_powers(graph_, roots_);
}

std::vector<std::vector<double>> FormulaFunction::evaluate(std::span<const NodeId> roots,
                                                           const std::vector<std::vector<double>>& values) const {
  const std::vector<Point> positions(values[0].size());
  Places places{.positions = positions};
  for (std::size_t k = 0; k < variables_.size(); ++k) places.attributes[variables_[k]] = values[k];
  return evaluate_places(graph_, {roots.begin(), roots.end()}, places, 0);
}

std::vector<double> FormulaFunction::at(const std::vector<std::vector<double>>& values) const {
  return std::move(evaluate(std::span(roots_).first(1), values)[0]);
}

std::vector<std::vector<double>> FormulaFunction::with_gradient(const std::vector<std::vector<double>>& values) const {
  return evaluate(roots_, values);
}

}  // namespace pelage
