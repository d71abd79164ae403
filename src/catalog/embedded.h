#pragma once
// The text files that are compiled into the program: models, recipes, regions and patches, *.toml each.

#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct EmbeddedFile {
  std::string_view path;  ///< for example "models/turing.toml"
  std::string_view text;
};

/// All embedded files, sorted by path. Defined in a source that the build writes.
const std::vector<EmbeddedFile>& embedded_files();

/// "turing" for every "models/turing.toml", sorted.
std::vector<std::string> embedded_names(std::string_view folder);

/// The path and text of the file of that name, or nullptr.
const EmbeddedFile* find_embedded(std::string_view folder, std::string_view name);

}  // namespace pelage
