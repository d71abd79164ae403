#pragma once
// Parameters of models on the command line.

#include <string>
#include <vector>

#include "command.h"
#include "pelage/recipe.h"
#include "react/model.h"

namespace pelage {

/// --set PARAM=VALUE, repeatable.
CLI::Option* add_settings_option(CLI::App& app, std::vector<std::string>& settings);

/// The model of that name or file with these settings. Error(Fault::usage) for unknown names.
Model load_model_with(const std::string& name_or_path, const std::vector<std::string>& settings);

}  // namespace pelage
