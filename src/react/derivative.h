#pragma once
// Symbolic derivatives.

#include <span>
#include <vector>

#include "react/expression.h"

namespace pelage {

/// The partial derivative of each root with respect to a symbol. At jumps and kinks (comparisons, floor, abs,
/// min, max, if) it is the derivative of the branch that is taken there.
std::vector<NodeId> derivative(Graph& graph, std::span<const NodeId> roots, NodeId variable);

}  // namespace pelage
