// A recipe of two stages with a progress that stops the work, and goes on from a checkpoint.
#include <pelage/grow.h>
#include <pelage/io.h>

#include <iostream>

const char* const two_stages = R"~(
stage = [ { name = "large", model = "turing", size = 0.4, steps = 60 },
          { name = "small", model = "turing", size = 0.2, steps = 40, mask = "large.b < 4", pin = { a = 4, b = 4 } } ]
)~";

int main() try {
  const pelage::Recipe recipe = pelage::parse_recipe(two_stages, "two stages");
  const pelage::TriangleMesh shape = pelage::load_shape("builtin:sphere?n=642");

  // A window would look here whether its button was pressed.
  const pelage::Progress half = [](std::string_view what, double fraction) {
    return what != "growing" || fraction < 0.5;
  };
  pelage::Growth stopped(shape, recipe, half);
  try {
    while (!stopped.done()) stopped.advance(10);
  } catch (const pelage::Error& error) {
    if (error.fault() != pelage::Fault::cancelled) throw;
    std::cout << "stopped in stage " << stopped.stage().name << " at step " << stopped.summary().steps << "\n";
  }
  pelage::Growth growth(shape, recipe);
  growth.restore(stopped.checkpoint());
  while (!growth.done()) growth.advance(10);
  pelage::save(growth.dress(), "coat.glb");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
