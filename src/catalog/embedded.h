#pragma once
// The text files that are compiled into the program: models/*.toml and recipes/*.toml.

#include <string_view>
#include <vector>

namespace pelage {

struct EmbeddedFile {
  std::string_view path;  ///< for example "models/turing.toml"
  std::string_view text;
};

/// All embedded files, sorted by path. Defined in a source that the build writes.
const std::vector<EmbeddedFile>& embedded_files();

}  // namespace pelage
