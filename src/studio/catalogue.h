#pragma once
// What the studio offers and knows before anything grows.

#include "pelage/recipe.h"
#include "studio/message.h"

namespace pelage {

/// Recipes, models, ramps, shapes and formats.
Message catalogue();

/// What linear theory knows of the model of a stage, by its number. Error(Fault::usage) where there is none.
Message analysed(const Recipe& recipe, std::size_t stage);

}  // namespace pelage
