#include "catalog/embedded.h"

#include <algorithm>

namespace pelage {

namespace {

constexpr std::string_view extension = ".toml";

}  // namespace

std::vector<std::string> embedded_names(std::string_view folder) {
  std::vector<std::string> names;
  const std::string begin = std::string(folder) + "/";
  for (const EmbeddedFile& f : embedded_files())
    if (f.path.starts_with(begin))
      names.emplace_back(f.path.substr(begin.size(), f.path.size() - begin.size() - extension.size()));
  return names;
}

const EmbeddedFile* find_embedded(std::string_view folder, std::string_view name) {
  const std::string path = std::string(folder) + "/" + std::string(name) + std::string(extension);
  const auto& files = embedded_files();
  const auto found = std::ranges::find(files, path, &EmbeddedFile::path);
  return found == files.end() ? nullptr : &*found;
}

}  // namespace pelage
