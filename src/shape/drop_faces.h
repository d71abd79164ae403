#pragma once
// Faces that add nothing to a surface: collapsed ones and copies of others.

#include <cstdint>
#include <vector>

#include "shape/finding.h"
#include "shape/numbered_mesh.h"

namespace pelage {

/// Removes the triangles that name a vertex twice and those with an edge of length zero (two corners at exactly
/// the same place). The edges beside an edge of length zero lie on each other and are stitched later, so that
/// no hole opens. Reports "degenerate-faces".
void drop_collapsed_faces(NumberedMesh& work, std::vector<Finding>& findings);

/// Keeps the first of all triangles with the same three vertices, in whatever order. Vertices of the same
/// place[v] count as one. Reports "duplicate-faces".
void drop_duplicate_faces(NumberedMesh& work, const std::vector<std::int32_t>& place, std::vector<Finding>& findings);

}  // namespace pelage
