#pragma once
// Names that recipes give to their stages and textures.

#include <string>

#include "pelage/recipe.h"

namespace pelage {

/// Letters, digits and _, as formulas know names; Error(Fault::usage), located, otherwise.
void require_name(const Given<std::string>& name);

}  // namespace pelage
