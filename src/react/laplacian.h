#pragma once
// Laplacians in formulas, lap(u): the constant coefficients with which they occur.

#include <vector>

#include "react/expression.h"
#include "react/lexer.h"

namespace pelage {

/// formula = rest + sum_j coefficient[j] lap(u_j), one coefficient per species.
struct LaplacianSplit {
  NodeId rest = -1;
  std::vector<double> coefficient;
};

/// True where the formula uses the Laplacian of any species.
bool has_laplacian(const Graph& graph, NodeId formula);

/// Takes the Laplacians out of a formula. Error(usage) at `where` when one of them does not occur linearly, or with a
/// coefficient that is not a number.
LaplacianSplit split_laplacians(Graph& graph, NodeId formula, const std::vector<NodeId>& species,
                                const std::vector<std::string>& names, const Location& where);

}  // namespace pelage
