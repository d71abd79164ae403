#include "catalog/recipes.h"

#include "base/suggest.h"
#include "catalog/embedded.h"
#include "pelage/grow.h"
#include "recipe/document.h"

namespace pelage {

namespace {

constexpr std::string_view recipe_folder = "recipes/", extension = ".toml";

std::string path_of(const std::string& name) { return std::string(recipe_folder) + name + std::string(extension); }

}  // namespace

std::vector<std::string> recipe_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& f : embedded_files())
    if (f.path.starts_with(recipe_folder))
      names.emplace_back(f.path.substr(recipe_folder.size(), f.path.size() - recipe_folder.size() - extension.size()));
  return names;
}

std::string recipe_text(const std::string& name) {
  for (const EmbeddedFile& f : embedded_files())
    if (f.path == path_of(name)) return std::string(f.text);
  throw Error(Fault::usage, unknown_name("recipe", name, recipe_names()));
}

Recipe load_recipe(const std::string& name_or_path) {
  if (name_or_path.ends_with(extension)) return parse_recipe(read_text(name_or_path), name_or_path);
  return parse_recipe(recipe_text(name_or_path), path_of(name_or_path));
}

}  // namespace pelage
