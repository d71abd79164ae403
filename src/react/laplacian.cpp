#include "react/laplacian.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "react/linear_split.h"

namespace pelage {

namespace {

bool uses(const Graph& graph, NodeId formula, NodeId symbol) {
  return std::ranges::count(reachable(graph, std::array{formula}), symbol) > 0;
}

}  // namespace

bool has_laplacian(const Graph& graph, NodeId formula) {
  return std::ranges::any_of(reachable(graph, std::array{formula}), [&](NodeId id) {
    return graph[id].op == Op::symbol && graph.symbol_of(id).kind == Symbol::Kind::laplacian;
  });
}

LaplacianSplit split_laplacians(Graph& graph, NodeId formula, const std::vector<NodeId>& species,
                                const std::vector<std::string>& names, const Location& where) {
  LaplacianSplit result{formula, std::vector<double>(species.size(), 0.0)};
  for (std::size_t j = 0; j < species.size() && has_laplacian(graph, result.rest); ++j) {
    const NodeId laplacian = graph.symbol({Symbol::Kind::laplacian, graph.symbol_of(species[j]).index});
    const LinearSplit split = linear_split(graph, result.rest, laplacian);
    const auto coefficient = graph.constant_value(split.c2);
    if (!coefficient || !std::isfinite(*coefficient) || uses(graph, split.c3, laplacian))
      throw Error(Fault::usage,
                  "lap(" + names[j] + ") must stand alone or times numbers and parameters; a coefficient that varies " +
                      "belongs in `diffusion`",
                  where);
    result.coefficient[j] = *coefficient;
    result.rest = split.c3;
  }
  return result;
}

}  // namespace pelage
