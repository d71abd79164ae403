// pelage recipes: the coats that come with the program.

#include "catalog/recipes.h"

#include <cstdio>
#include <memory>

#include "base/suggest.h"
#include "command.h"
#include "pelage/grow.h"
#include "table.h"

namespace pelage {

namespace {

void print_list(const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows = {{"NAME", "MODELS", "SUMMARY"}};
  for (const std::string& name : names) {
    const Recipe r = load_recipe(name);
    std::vector<std::string> models;
    for (const Stage& stage : r.stages) models.push_back(stage.model.value);
    rows.push_back({name, join_names(models), r.summary});
  }
  std::fputs(table(rows).c_str(), stdout);
}

void print_list_as_json(const std::vector<std::string>& names) {
  Json list = Json::array();
  for (const std::string& name : names) {
    const Recipe r = load_recipe(name);
    Json stages = Json::array();
    for (const Stage& stage : r.stages) stages.push_back({{"name", stage.name.value}, {"model", stage.model.value}});
    list.push_back({{"name", name}, {"summary", r.summary}, {"shape", r.shape}, {"stages", stages}});
  }
  print_json(list);
}

struct RecipesOptions {
  std::string name;
  bool json = false;
};

void recipes(const RecipesOptions& options) {
  if (!options.name.empty())
    std::fputs(recipe_text(options.name).c_str(), stdout);
  else if (options.json)
    print_list_as_json(recipe_names());
  else
    print_list(recipe_names());
}

}  // namespace

Command add_recipes(CLI::App& parent) {
  auto options = std::make_shared<RecipesOptions>();
  CLI::App* app = parent.add_subcommand("recipes",
                                        "List the built-in recipes, or print one\n"
                                        "These are what grow --recipe NAME knows; --recipe also takes the path of a "
                                        ".toml file of your own, which may begin "
                                        "as a copy of one of these.");
  CLI::Option* name = app->add_option("NAME", options->name, "Print the text of this one")->type_name("");
  app->add_flag("--json", options->json, "Print the list as JSON")->excludes(name);
  app->footer(
      "Examples:\n  pelage recipes\n  pelage recipes zebra > mine.toml\n  pelage grow --recipe demo -o cub.glb");
  return {app, [options] { recipes(*options); }};
}

}  // namespace pelage
