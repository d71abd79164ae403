#pragma once
// Sewing patches together.

#include <functional>

#include "pelage/atlas.h"

namespace pelage {

/// Unites the nodes on the borders of patches (and on two borders of the same) that lie within a billionth of the
/// diagonal from each other, and finds which side of each is outside. Attributes stay with the patches.
/// Error(Fault::input) that names the sides: where borders have the same ends and the same course but other nodes, or
/// meet along a part; where more than two patches share an edge; and for patches that are no closed sheets.
Atlas sew(std::vector<Atlas::Patch> patches);

/// Shared nodes as vertices, cells as two triangles each (one where a side has no length); no attributes.
TriangleMesh mesh_of(const Atlas& atlas);

/// use(patch, triangle) for every triangle of that mesh, in its order, with the numbers of nodes of the patch.
void for_triangles(const Atlas& atlas, const std::function<void(std::size_t, const Triangle&)>& use);

/// Values of a patch's nodes, from those of the atlas' nodes with so many components each.
std::vector<double> on_patch(const Atlas::Patch& patch, const std::vector<double>& values, std::size_t components);

}  // namespace pelage
