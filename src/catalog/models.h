#pragma once
// The reaction models: those compiled in from models/*.toml, and files of the user.

#include <string>
#include <string_view>
#include <vector>

#include "pelage/recipe.h"
#include "react/model.h"

namespace pelage {

struct ModelEntry {
  std::string name;    ///< what load_model takes: "turing", or "turing:production" for a variant
  ModelSource source;  ///< with the variant's values
};

/// Every built-in model and variant, sorted by name, each model before its variants.
const std::vector<ModelEntry>& model_list();

/// The source of a model: the name of a built-in one or the path of a file ending in .toml, with ":VARIANT" appended
/// for a variant. Error(usage) for an unknown name, Error(input) for a file that cannot be read, Error(usage) with
/// file, line and column for a fault in it.
ModelSource load_model(const std::string& name_or_path);

/// The same, but first among the texts, whose faults are located under their names.
ModelSource find_model(const std::string& name_or_path, const ModelTexts& texts);

/// How the model shows itself, the same for its variants: [look] of the file, as in recipes. Errors likewise.
Look model_look(const std::string& name_or_path, const ModelTexts& texts);

/// The source that a text describes; `file` is the name for messages.
ModelSource parse_model(std::string_view text, const std::string& file);

}  // namespace pelage
