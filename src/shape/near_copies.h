#pragma once
// Seams that are open by a hair.

#include <vector>

#include "shape/finding.h"
#include "shape/numbered_mesh.h"

namespace pelage {

/// Reports "near-copies": vertices on open edges that lie within a millionth of the bounding-box diagonal of
/// another one, as after rounding in a file. They are not merged (which of them are meant to be one is for the
/// user to say), but the surface is cut there. A few may be missed: only cells of a grid are compared.
void report_near_copies(const NumberedMesh& work, std::vector<Finding>& findings);

}  // namespace pelage
