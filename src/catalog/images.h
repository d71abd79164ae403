#pragma once
// The images of a recipe as textures.

#include <vector>

#include "pelage/recipe.h"
#include "shape/texture.h"

namespace pelage {

/// In the order of the recipe. Error(Fault::input) for those that cannot be read.
std::vector<Texture> read_images(const std::vector<TextureFile>& files);

}  // namespace pelage
