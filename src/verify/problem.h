#pragma once
// A surface with its matrices, as the verifications need it.

#include "discretise/sampling.h"

namespace pelage {

inline Discretisation make_loop(Topology t) { return loop_discretisation(std::move(t)); }
inline Discretisation make_linear(Topology t) { return linear_discretisation(std::move(t)); }

struct Problem {
  Discretisation discretisation;
  std::vector<Point> control;
  SparseMatrix mass, stiffness;
};

/// `discretise`: make_loop or make_linear; `interpolate`: the limit surface passes through the given points.
Problem make_problem(const TriangleMesh& mesh, Discretisation (*discretise)(Topology), bool interpolate);

}  // namespace pelage
