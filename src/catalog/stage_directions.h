#pragma once
// What the directions of a stage ask for, on a shape.

#include "direction/guides.h"
#include "pelage/recipe.h"
#include "react/model.h"
#include "shape/texture.h"

namespace pelage {

/// The wish of stage.directions, which is there; on a stand-in without triangles no vertices are marked. `diagonal` of
/// the shape's bounding box. Error(Fault::usage), located, for a model without anisotropic diffusion and for formulas
/// that mark no vertex or read what is not known yet.
FieldWish resolve_directions(const Stage& stage, const Model& model, const TriangleMesh& shape,
                             const std::vector<Texture>& textures, double diagonal);

}  // namespace pelage
