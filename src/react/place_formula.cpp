#include "react/place_formula.h"

#include "react/formula.h"
#include "react/place_values.h"

namespace pelage {

namespace {

/// By how much a condition holds; nothing for a number.
std::optional<Term> margin_of(Graph& graph, NodeId id) {
  const Node node = graph[id];
  const auto operand = [&](std::size_t k) { return Term{&graph, node.in[k]}; };
  const auto both = [&](Op op) -> std::optional<Term> {
    const std::optional<Term> a = margin_of(graph, node.in[0]), b = margin_of(graph, node.in[1]);
    if (!a || !b) return {};
    return Term{&graph, graph.make(op, a->id, b->id)};
  };
  switch (node.op) {
    case Op::less:
    case Op::less_equal:
      return operand(1) - operand(0);
    case Op::equal: {
      const Term apart = operand(1) - operand(0);
      return 0.5 - Term{&graph, graph.make(Op::absolute, apart.id)};
    }
    case Op::logical_and:
      return both(Op::minimum);
    case Op::logical_or:
      return both(Op::maximum);
    case Op::logical_not: {
      const std::optional<Term> a = margin_of(graph, node.in[0]);
      return a ? std::optional(-*a) : a;
    }
    default:
      return {};
  }
}

}  // namespace

PlaceFormula::PlaceFormula(const Formula& formula, const std::vector<std::string>& names,
                           const std::map<std::string, double>& numbers) {
  Scope scope;
  for (const auto& [name, value] : numbers) scope.names[name] = graph_.constant(value);
  for (const std::string& name : names) {
    Symbol symbol{Symbol::Kind::attribute};
    symbol.name = name;
    symbol.where = formula.where;
    scope.names[name] = graph_.symbol(symbol);
  }
  root_ = parse_formula(graph_, formula, scope, "definitions.formula_of_the_place");
  if (graph_[root_].dependence & (on_species | on_time))
    throw Error(Fault::usage, "this can depend on the place only, not on time", formula.where);
  root_ = expand_powers(graph_, std::vector<NodeId>{root_})[0];
}

std::optional<PlaceFormula> PlaceFormula::margin() const {
  PlaceFormula result = *this;
  const std::optional<Term> margin = margin_of(result.graph_, root_);
  if (!margin) return {};
  result.root_ = margin->id;
  return result;
}

std::vector<Symbol> PlaceFormula::symbols() const { return place_symbols(graph_, {root_}); }

std::vector<double> PlaceFormula::at(const Places& places, std::uint64_t seed) const {
  if (const auto constant = graph_.constant_value(root_))
    return std::vector<double>(places.positions.size(), *constant);
  return std::move(evaluate_places(graph_, {root_}, places, seed)[0]);
}

}  // namespace pelage
