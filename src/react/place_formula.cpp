#include "react/place_formula.h"

#include "react/formula.h"
#include "react/place_values.h"

namespace pelage {

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

std::vector<Symbol> PlaceFormula::symbols() const { return place_symbols(graph_, {root_}); }

std::vector<double> PlaceFormula::at(const Places& places, std::uint64_t seed) const {
  if (const auto constant = graph_.constant_value(root_))
    return std::vector<double>(places.positions.size(), *constant);
  return std::move(evaluate_places(graph_, {root_}, places, seed)[0]);
}

}  // namespace pelage
