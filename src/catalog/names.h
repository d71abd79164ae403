#pragma once
// Names that recipes give to their stages and textures.

#include <string>
#include <vector>

#include "pelage/recipe.h"

namespace pelage {

/// Letters, digits and _, as formulas know names; Error(Fault::usage), located, otherwise.
void require_name(const Given<std::string>& name);

/// Adds the attributes of a texture of that name to those that there are; Error(Fault::usage), located, where it would
/// hide one.
void take_texture_name(const Given<std::string>& texture, std::vector<std::string>& attributes);

}  // namespace pelage
