#pragma once
// From fields on a surface to a mesh with colours.

#include "look/tessellation.h"

namespace pelage {

/// Attributes of the shape make room for those of the coat: "color" and, where the paint has the fields in it, what is
/// called as they are become "input_NAME"; and those of its channels. What was called so before gets another "input_"
/// in front.
void rename_input(std::vector<Attribute>& attributes, const Paint& paint);

/// The tessellation with "normal" (unit; at corners where it is sharp), "color" (linear light), what the paint says of
/// channels, one attribute per species if the paint has them in it, and the attributes and links of the shape.
/// `uniform` as in CoatFields.
TriangleMesh dress(Tessellation tessellation, const Paint& paint, const std::vector<char>& uniform);

/// The same in the colours of a palette.
TriangleMesh dress(Tessellation tessellation, const Palette& palette);

/// What a coat on the mesh of a grid has at its vertices, as attributes of the grid; even grids need no normals.
Grid on_grid(Grid grid, const TriangleMesh& coat);

/// At the nodes of a shape whose nodes are what they are: what files of these have. The errors of the next one.
TriangleMesh dress_nodes(const CoatFields& fields, const Look& look);

/// All at once. Error(Fault::usage) for an unknown species or ramp, faults in layers, or a detail that needs too many
/// triangles.
TriangleMesh dress(const CoatFields& fields, const Look& look);

}  // namespace pelage
