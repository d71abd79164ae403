// A recipe as it is, and with what the options of pelage grow change in it.
#include <pelage/grow.h>
#include <pelage/recipe_changes.h>

#include <iostream>

int main() try {
  pelage::RecipeChanges changes;
  changes.quality = "draft";
  changes.size = "0.2";
  changes.seed = 7;
  changes.settings = {"large.s=0.06"};
  const pelage::Recipe recipe = pelage::with_changes(pelage::load_recipe("leopard"), changes);
  for (const pelage::Stage& stage : recipe.stages)
    std::cout << stage.name.value << ": size " << stage.size->value.value << ", seed " << stage.seed << "\n";
  return recipe.stages[1].size->value.value < 0.2 ? 0 : 1;  // the sizes keep their proportion
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
