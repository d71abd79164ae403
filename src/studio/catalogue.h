#pragma once
// What the studio offers and knows before anything grows.

#include "pelage/recipe.h"
#include "react/model.h"
#include "studio/message.h"

namespace pelage {

/// Recipes, models, ramps, shapes and formats.
Message catalogue();

/// Names, values, ranges and meanings, as the page makes sliders of them.
Header described(const std::vector<ParameterSource>& parameters);

/// The model of a stage, by its number, with the stage's parameters. Error(Fault::usage) where there is none.
Model planned_model(const Recipe& recipe, std::size_t stage);

/// What linear theory knows of the model of a stage, by its number. Error(Fault::usage) where there is none.
Message analysed(const Recipe& recipe, std::size_t stage);

}  // namespace pelage
