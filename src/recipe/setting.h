#pragma once
// Parameters of models as texts.

#include <string>

#include "pelage/recipe.h"

namespace pelage {

/// "PARAM=VALUE". Error(Fault::usage) for anything else, in the name of the option that it was given by.
Stage::Setting parse_setting(const std::string& text, const std::string& option);

}  // namespace pelage
