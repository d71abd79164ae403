#pragma once
// Formulas of the place at the vertices of a mesh, before there is a surface.

#include "react/place_formula.h"
#include "shape/texture.h"

namespace pelage {

/// Whether the formula depends on no more than a mesh tells: neither curvatures nor fields of earlier stages.
bool known_from_mesh(const PlaceFormula& formula);

/// One value per vertex. `textures`: those that the formula reads; the mesh has "uv" if there are any.
std::vector<double> vertex_values(const PlaceFormula& formula, const TriangleMesh& mesh,
                                  const std::vector<Texture>& textures, std::uint64_t seed);

}  // namespace pelage
