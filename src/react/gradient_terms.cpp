#include "react/gradient_terms.h"

#include <algorithm>
#include <cmath>

#include "react/linear_split.h"

namespace pelage {

namespace {

std::vector<NodeId> symbols(const Graph& graph, std::span<const NodeId> formulas, Symbol::Kind kind) {
  std::vector<NodeId> found;
  for (const NodeId id : reachable(graph, formulas))
    if (graph[id].op == Op::symbol && graph.symbol_of(id).kind == kind) found.push_back(id);
  return found;
}

void add(Graph& graph, std::vector<Flux>& fluxes, std::size_t of, NodeId coefficient) {
  const auto same = std::ranges::find(fluxes, of, &Flux::of);
  if (same == fluxes.end())
    fluxes.push_back({0, of, coefficient});
  else
    same->coefficient = graph.make(Op::add, same->coefficient, coefficient);
}

}  // namespace

FluxSplit split_fluxes(Graph& graph, NodeId formula, const Location& where) {
  FluxSplit result{formula, {}};
  for (const NodeId divergence : symbols(graph, std::array{formula}, Symbol::Kind::divergence)) {
    const LinearSplit split = linear_split(graph, result.rest, divergence);
    const auto factor = graph.constant_value(split.c2);
    const auto left = symbols(graph, std::array{split.c3}, Symbol::Kind::divergence);
    if (!factor || !std::isfinite(*factor) || std::ranges::count(left, divergence) > 0)
      throw Error(Fault::usage, "div() must stand alone or times numbers and parameters; what varies belongs inside",
                  where);
    const Symbol symbol = graph.symbol_of(divergence);
    add(graph, result.fluxes, static_cast<std::size_t>(symbol.index), graph.make(Op::multiply, split.c2, symbol.other));
    result.rest = split.c3;
  }
  return result;
}

std::vector<NodeId> gradient_products(const Graph& graph, std::span<const NodeId> formulas) {
  return symbols(graph, formulas, Symbol::Kind::gradients);
}

std::string differential_operator(const Graph& graph, NodeId formula) {
  for (const NodeId id : reachable(graph, std::array{formula})) {
    if (graph[id].op != Op::symbol) continue;
    const Symbol& symbol = graph.symbol_of(id);
    if (symbol.kind == Symbol::Kind::laplacian) return "lap()";
    if (symbol.kind == Symbol::Kind::gradients) return symbol.index == symbol.other ? "grad2()" : "dot()";
    if (symbol.kind == Symbol::Kind::divergence) return "div()";
  }
  return "";
}

}  // namespace pelage
