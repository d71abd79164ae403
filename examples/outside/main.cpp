// Uses an installed pelage from outside its source tree: grows a coat for a few steps and saves it.
#include <pelage/pelage.h>

#include <iostream>

int main() {
  try {
    pelage::Recipe recipe = pelage::load_recipe("demo");
    recipe.stages[0].size =
        pelage::Given<pelage::Length>{{0.3, pelage::Length::Unit::world}, {}};  // of the bounding box's diagonal
    pelage::Growth growth(pelage::load_shape("builtin:sphere?n=642"), recipe);
    growth.advance(5);
    const pelage::TriangleMesh coat = growth.dress();
    pelage::save(coat, "coat.glb");
    std::cout << coat.triangles.size() << " triangles with " << (coat.find("color") ? "a coat" : "no coat") << "\n";
    return coat.find("color") ? 0 : 1;
  } catch (const pelage::Error& error) {
    std::cerr << "outside: error: " << error.what() << "\n";
    return static_cast<int>(error.fault());
  }
}
