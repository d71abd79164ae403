#pragma once
// What a stage of a recipe changes in its model. All of it is put in terms of the model's own language, so that nothing
// below this layer knows of it: a map of a parameter is a definition, the inside of a mask a condition in the formulas.

#include "pelage/recipe.h"
#include "react/model.h"

namespace pelage {

/// The model of a stage with its formulas and its mask built in; numbers for parameters are left to compile().
/// `fields`: names of the fields that the stages before it leave behind. Error(usage), located, for unknown names.
ModelSource stage_model(const ModelSource& model, const Stage& stage, const std::vector<std::string>& fields);

}  // namespace pelage
