// Gives a mesh without texture coordinates an atlas, and says how good it is.
#include <pelage/io.h>
#include <pelage/unwrap.h>

#include <iostream>

int main() try {
  pelage::PolygonMesh mesh = pelage::polygons_of(pelage::load_shape("builtin:animal?n=1000"));

  pelage::UnwrapOptions options;
  options.resolution = 1024;  // of the texture to come
  options.margin = 4;         // texels between charts
  const pelage::Unwrapped unwrapped = pelage::unwrap(mesh, options);
  std::cout << unwrapped.report.charts << " charts, stretched by " << unwrapped.report.stretch << "\n";

  mesh.set(unwrapped.uv);
  pelage::save(mesh, "animal_uv.obj");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
