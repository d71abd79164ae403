#pragma once
// From a finished run to a mesh with colours: samples on the limit surface become colours, normals and attributes.

#include "pelage/recipe.h"
#include "pelage/triangle_mesh.h"
#include "run/run.h"

namespace pelage {

/// The surface, tessellated, with "normal" (unit), "color" (linear light), one attribute per species, and the vertex and
/// corner attributes of the run's shape, interpolated linearly in every triangle. Either the limit surface, or with
/// look.keep_shape the flat triangles of the shape with its vertices first and unmoved, every point coloured from the
/// point of the limit surface with the same barycentric coordinates.
TriangleMesh dress(const Run& run, const Look& look);

}  // namespace pelage
