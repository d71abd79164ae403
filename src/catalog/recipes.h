#pragma once
// The recipes: those compiled in from recipes/*.toml, and files of the user.

#include <string>
#include <vector>

#include "pelage/recipe.h"

namespace pelage {

/// The built-in recipe of that name, or the one in the file when the name ends in .toml. Error(usage) for an unknown
/// name, Error(input) for a file that cannot be read, Error(usage), located, for faults in it.
Recipe load_recipe(const std::string& name_or_path);
std::vector<std::string> recipe_names();

}  // namespace pelage
