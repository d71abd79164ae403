#pragma once
// What a stage of a recipe changes in its model.

#include "pelage/recipe.h"
#include "react/model.h"

namespace pelage {

/// `fields`: names of the fields that the stages before it leave behind. Error(usage), located, for unknown names.
ModelChanges stage_changes(const ModelSource& model, const Stage& stage, const std::vector<std::string>& fields);

}  // namespace pelage
