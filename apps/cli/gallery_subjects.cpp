#include "gallery_subjects.h"

#include <filesystem>

#include "catalog/models.h"
#include "catalog/plan.h"
#include "input_unit.h"
#include "pelage/grow.h"
#include "pelage/io.h"

namespace pelage {

namespace {

bool names_variant(const std::string& name) { return !name.ends_with(".toml") && name.find(':') != std::string::npos; }

/// The models that were asked for, each with its variants; all when none was.
std::vector<ModelEntry> wanted_models(const std::vector<std::string>& names) {
  if (names.empty()) return model_list();
  std::vector<ModelEntry> list;
  for (const std::string& name : names) {
    list.push_back({name, load_model(name)});
    if (names_variant(name)) continue;
    const ModelSource source = list.back().source;
    for (const VariantSource& v : source.variants) list.push_back({name + ":" + v.name, with_variant(source, v.name)});
  }
  return list;
}

}  // namespace

std::vector<GallerySubject> model_subjects(const std::vector<std::string>& names, const Length& size) {
  std::vector<GallerySubject> subjects;
  for (const ModelEntry& m : wanted_models(names)) {
    Recipe recipe;
    recipe.stages[0].model.value = m.name;
    recipe.stages[0].size = {size, {}};
    plan(recipe);
    recipe.look = shown_look(recipe);
    const bool variant = names_variant(m.name);
    subjects.push_back(
        {m.name, m.source.title, variant ? "" : m.source.summary, variant ? "" : m.source.cite, std::move(recipe)});
  }
  return subjects;
}

std::vector<GallerySubject> recipe_subjects(const std::vector<std::string>& names) {
  std::vector<GallerySubject> subjects;
  for (const std::string& name : names.empty() ? recipe_names() : names) {
    Recipe recipe = load_recipe(name);
    plan(recipe);
    recipe.look = shown_look(recipe);
    subjects.push_back({name, recipe.summary.empty() ? recipe.name : recipe.summary, "", "", std::move(recipe)});
  }
  return subjects;
}

std::vector<GalleryShape> gallery_shapes(const std::vector<std::string>& paths, bool of_recipes,
                                         const std::optional<double>& metres_per_unit) {
  std::vector<GalleryShape> shapes;
  for (const std::string& path : paths) {
    const bool built_in = path.starts_with("builtin:");
    const std::string name =
        built_in ? path.substr(8, path.find('?') - 8) : std::filesystem::path(path).stem().string();
    shapes.push_back({name, read_shape(path, metres_per_unit)});
  }
  if (!shapes.empty()) return shapes;
  // Coarse enough that the pattern alone decides how fine the mesh gets.
  const char* first = of_recipes ? "builtin:torus?n=2000" : "builtin:sphere?n=642";
  return gallery_shapes({first, "builtin:animal?n=3000"}, of_recipes);
}

}  // namespace pelage
