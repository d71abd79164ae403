#pragma once
// Gradients in formulas: grad2(u), dot(grad u, grad v), which steppers see as values at the samples beside those of the
// species, and div(c grad u), which they see as loads.

#include <string>
#include <vector>

#include "react/expression.h"

namespace pelage {

/// The part div(c grad u) of the rate of a species.
struct Flux {
  std::size_t species = 0;  ///< in whose rate it is
  std::size_t of = 0;       ///< u
  NodeId coefficient = -1;  ///< c: concentration of `species` * model length unit^2 / (time * concentration of u)
};

/// formula = rest + sum of the fluxes, at most one of each species; their `species` is not set.
struct FluxSplit {
  NodeId rest = -1;
  std::vector<Flux> fluxes;
};

/// Takes the divergences out of a formula. Error(usage) at `where` when one of them does not occur linearly, or with a
/// factor that is not a number.
FluxSplit split_fluxes(Graph& graph, NodeId formula, const Location& where);

/// The products of gradients that the formulas use, in order of number.
std::vector<NodeId> gradient_products(const Graph& graph, std::span<const NodeId> formulas);

/// "lap()", "grad2()", "dot()" or "div()", the first that a formula uses, or nothing.
std::string differential_operator(const Graph& graph, NodeId formula);

}  // namespace pelage
