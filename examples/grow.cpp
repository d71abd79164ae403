// Grows a coat and dresses it twice: the second time costs only the colours.
#include <pelage/grow.h>
#include <pelage/io.h>

#include <iostream>

int main() try {
  pelage::Recipe recipe = pelage::load_recipe("demo");
  recipe.stages[0].size = pelage::Given<pelage::Length>{{0.2}, {}};  // of the bounding box's diagonal

  pelage::Growth growth(pelage::load_shape("builtin:sphere?n=642"), recipe);
  while (!growth.done()) growth.advance(10);
  for (const std::string& warning : growth.warnings()) std::cerr << "warning: " << warning << "\n";
  std::cout << growth.summary().steps << " steps to time " << growth.summary().time << "\n";
  if (growth.uniform()) std::cout << "no pattern: " << growth.why_uniform() << "\n";

  pelage::save(growth.dress(), "coat.glb");
  pelage::Look look = recipe.look;
  look.ramp.value = "leopard";
  pelage::save(growth.dress(look), "leopard.glb");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
