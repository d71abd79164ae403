#pragma once
// What a run is going to need, before it takes it.

#include "run/program.h"

namespace pelage {

/// Estimates: of nodes within a few percent on even meshes, of memory within a third.
struct Forecast {
  double nodes = 0;      ///< of the space: vertices, cells or nodes
  double triangles = 0;  ///< between them, where there are any
  double bytes = 0;      ///< that world and stages take, beside what the shape has already
};

Forecast forecast(const Program& program);

/// Error(Fault::numerics) where a run of that program needs more memory than is left, with the pattern that would fit.
void require_memory(const Program& program);

}  // namespace pelage
