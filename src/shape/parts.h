#pragma once
// Named parts of a shape (the face attribute "object": solids of STL, objects of OBJ, nodes of glTF) that touch.

#include <cstdint>
#include <vector>

#include "shape/edges.h"
#include "shape/finding.h"
#include "shape/numbered_mesh.h"

namespace pelage {

/// The part of every triangle; empty where the mesh has no parts.
std::vector<std::int32_t> parts_of(const TriangleMesh& mesh);

/// Gives every part that is closed by itself vertices of its own, even where the file shares them with another part.
/// Reports "touching-parts".
void separate_closed_parts(NumberedMesh& work, std::vector<Finding>& findings);

/// Like open_places() of stitch.h, but vertices of different parts count as one only if that closes the surface: parts
/// whose open edges all lie on those of others are pieces of one surface, and everything else that touches stays apart,
/// which is reported as "parts-apart".
std::vector<std::int32_t> open_places_in_parts(const TriangleMesh& mesh, const EdgeTable& edges,
                                               const std::vector<std::int32_t>& part, std::vector<Finding>& findings);

}  // namespace pelage
