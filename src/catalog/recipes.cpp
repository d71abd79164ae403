#include "catalog/recipes.h"

#include "base/suggest.h"
#include "catalog/embedded.h"
#include "pelage/grow.h"
#include "recipe/document.h"

namespace pelage {

std::vector<std::string> recipe_names() { return embedded_names("recipes"); }

namespace {

const EmbeddedFile& recipe_file(const std::string& name) {
  if (const EmbeddedFile* f = find_embedded("recipes", name)) return *f;
  throw Error(Fault::usage, unknown_name("recipe", name, recipe_names()));
}

}  // namespace

std::string recipe_text(const std::string& name) { return std::string(recipe_file(name).text); }

Recipe load_recipe(const std::string& name_or_path) {
  if (name_or_path.ends_with(".toml")) return parse_recipe(read_text(name_or_path), name_or_path);
  const EmbeddedFile& f = recipe_file(name_or_path);
  return parse_recipe(std::string(f.text), std::string(f.path));
}

}  // namespace pelage
