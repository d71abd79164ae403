#pragma once
// The images of a recipe, looked up and read.

#include <vector>

#include "pelage/recipe.h"
#include "react/kinetics.h"
#include "shape/texture.h"

namespace pelage {

/// All that attribute(NAME) may read from the shape and its textures, without values.
Places named_places(const TriangleMesh& shape, const std::vector<Texture>& textures);

/// Of a stand-in without triangles, the names alone; their images are looked at but not read. Error(Fault::usage),
/// located, for a name that is taken and a shape without uv; Error(Fault::input) for images that cannot be read.
std::vector<Texture> resolve_textures(const std::vector<TextureFile>& files, const TriangleMesh& shape);

}  // namespace pelage
