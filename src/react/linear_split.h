#pragma once
// The reaction term of the generalised PDE (eq. 2 of Bajaj, Zhang, Xu 2008) as R(u) = C2 u + C3.

#include "react/expression.h"

namespace pelage {

struct LinearSplit {
  NodeId c2 = -1;
  NodeId c3 = -1;
};

/// Splits a rate R into C2 u + C3 for the species u, all other species being held. Where R is a polynomial in
/// u, C3 = R(u=0) and C2 = (R - C3)/u by exact division, which is the split of the paper's Fig. 2: u^2 v
/// gives C2 = u v. Elsewhere it is the linearisation at the present value: C2 = dR/du, C3 = R - C2 u.
LinearSplit linear_split(Graph& graph, NodeId rate, NodeId species);

}  // namespace pelage
