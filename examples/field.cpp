// Two direction fields on one mesh: the smoothest one, and one around an axis.
#include <pelage/field.h>
#include <pelage/io.h>

#include <iostream>

int main() try {
  const pelage::TriangleMesh mesh = pelage::load_shape("builtin:animal?n=600");
  const pelage::FieldMaker maker(mesh);
  std::cout << maker.make().singularities.size() << " singular triangles in the smoothest field of lines\n";

  pelage::FieldOptions around;
  around.axis = pelage::Point{0, 0, 1};
  around.across = true;
  const pelage::SurfaceField field = maker.make(around);
  pelage::save(pelage::with_directions(mesh, field.direction), "field.ply");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
