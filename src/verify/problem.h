#pragma once
// A surface with its matrices, as the verifications need it.

#include <functional>

#include "discretise/sampling.h"

namespace pelage {

struct Problem {
  Discretisation discretisation;
  std::vector<Point> control;
  SparseMatrix mass, stiffness;
};

/// `interpolate`: the limit surface passes through the given points.
Problem make_problem(const TriangleMesh& mesh, const std::string& method, bool interpolate);

}  // namespace pelage
