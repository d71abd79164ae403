// Two pictures of a coat from two sides. Link pelage::render beside pelage::pelage.
#include <pelage/grow.h>
#include <pelage/io.h>
#include <pelage/render.h>

#include <iostream>

int main() try {
  pelage::Recipe recipe = pelage::load_recipe("demo");
  recipe.stages[0].size = pelage::Given<pelage::Length>{{0.2}, {}};
  pelage::PictureScene scene(pelage::grow(pelage::load_shape("builtin:sphere?n=642"), recipe));

  pelage::PictureOptions options;
  options.width = options.height = 64;
  options.samples = 8;
  pelage::write_png(scene.render(options), "front.png");
  options.azimuth = 90;
  pelage::write_png(scene.render(options), "side.png");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
