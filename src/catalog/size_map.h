#pragma once
// How small a map of the size makes a pattern.

#include <vector>

#include "pelage/recipe.h"
#include "shape/texture.h"

namespace pelage {

/// The smallest factor of the stage's map over the vertices of the shape; 1 without a map, for a stand-in without
/// triangles, and where the map depends on what is not known yet. For the details that a texture has between the
/// vertices, the shape is split until its edges are as short as the map asks, `edge` being short enough for a factor of
/// 1. Error(Fault::usage), located, when a factor is not greater than 0.
double smallest_factor(const Stage& stage, const TriangleMesh& shape, const std::vector<Texture>& textures,
                       double edge);

}  // namespace pelage
