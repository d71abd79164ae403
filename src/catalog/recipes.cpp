#include "base/suggest.h"
#include "catalog/embedded.h"
#include "pelage/grow.h"
#include "recipe/document.h"

namespace pelage {

namespace {

constexpr std::string_view recipe_folder = "recipes/", extension = ".toml";

}  // namespace

std::vector<std::string> recipe_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& f : embedded_files())
    if (f.path.starts_with(recipe_folder))
      names.emplace_back(f.path.substr(recipe_folder.size(), f.path.size() - recipe_folder.size() - extension.size()));
  return names;
}

Recipe load_recipe(const std::string& name_or_path) {
  if (name_or_path.ends_with(extension)) return parse_recipe(read_text(name_or_path), name_or_path);
  for (const EmbeddedFile& f : embedded_files())
    if (f.path == std::string(recipe_folder) + name_or_path + std::string(extension))
      return parse_recipe(std::string(f.text), std::string(f.path));
  throw Error(Fault::usage, unknown_name("recipe", name_or_path, recipe_names()));
}

}  // namespace pelage
