// Grows a model that is given as text; docs/models.md says what it may hold.
#include <pelage/grow.h>
#include <pelage/io.h>

#include <iostream>

const char* const schnakenberg = R"~(
name = "mine"
[parameters]
d = 40
[species.u]
diffusion = "1"
rate = "0.1 - u + u^2*v"
initial = "1 + 0.02*noise(1)"
[species.v]
diffusion = "d"
rate = "0.9 - u^2*v"
initial = "0.9"
[suggested]
step = 0.2
end = 60
)~";

int main() try {
  pelage::Recipe recipe;
  recipe.models["mine"].text = schnakenberg;
  pelage::Stage& stage = recipe.stages[0];
  stage.model.value = "mine";
  stage.parameters = {{"d", 30, {}}};
  stage.size = pelage::Given<pelage::Length>{{0.25}, {}};
  recipe.look.species = pelage::Given<std::string>{"u", {}};
  pelage::save(pelage::grow(pelage::load_shape("builtin:sphere?n=642"), recipe), "coat.ply");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
