#pragma once
// A direction field to look at: strokes on the surface along its directions, and a ball on every singularity.

#include "direction/direction_field.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

struct HatchingOptions {
  double spacing = 0;  ///< between strokes [world units]; 0: a fiftieth of the bounding box' diagonal
};

/// The mesh with "normal" and "color" at its vertices, and drawn on it ribbons that follow the field: tapered at both
/// ends where the field has lines or crosses, pointed at the head where it has vectors (n = 1). Singularities of
/// positive index carry a red ball, negative ones a blue one. `connection` and `field` belong to `mesh`.
TriangleMesh hatched(const TriangleMesh& mesh, const Connection& connection, const DirectionField& field,
                     const HatchingOptions& options = {});

}  // namespace pelage
