#pragma once
// The recipes that are compiled in, as text.

#include <string>

namespace pelage {

/// The text of a built-in recipe. Error(Fault::usage) for an unknown name.
std::string recipe_text(const std::string& name);

}  // namespace pelage
