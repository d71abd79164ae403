#pragma once
// From fields on a surface to a mesh with colours.

#include "look/tessellation.h"

namespace pelage {

/// The tessellation with "normal" (unit), "color" (linear light), one attribute per species, and the vertex and corner
/// attributes of the shape. `uniform` as in CoatFields.
TriangleMesh dress(Tessellation tessellation, const Paint& paint, const std::vector<char>& uniform);

/// All at once. Error(Fault::usage) for an unknown species or ramp, faults in layers, or a detail that needs too many
/// triangles.
TriangleMesh dress(const CoatFields& fields, const Look& look);

}  // namespace pelage
