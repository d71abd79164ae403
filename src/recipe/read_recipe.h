#pragma once
// Recipes inside of other documents.

#include <string>

#include "pelage/recipe.h"
#include "recipe/document.h"

namespace pelage {

/// What a table says as recipes do; other keys remain unread. `name`: where it has none. Error(Fault::usage), located.
Recipe read_recipe(const Value& table, const std::string& name);

/// The same of a look.
Look read_look(const Value& table);

}  // namespace pelage
