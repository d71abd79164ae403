#pragma once
// One side of the surface is the outside, everywhere the same one.

#include <vector>

#include "shape/edges.h"
#include "shape/finding.h"
#include "shape/numbered_mesh.h"

namespace pelage {

/// Reverses triangles so that neighbours agree (shared edges run in opposite directions) and closed components
/// enclose a positive volume. An open component keeps the orientation of most of its triangles.
/// `opposite` as from pair_half_edges, after renumber_by_fans; it does not hold for the reversed triangles.
/// Throws ShapeFault for a one-sided surface. Reports "flipped-faces" (against their neighbours) and
/// "inward-components" (as a whole).
void orient(NumberedMesh& work, const std::vector<HalfEdge>& opposite, std::vector<Finding>& findings);

}  // namespace pelage
