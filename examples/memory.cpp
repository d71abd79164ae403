// A shape from bytes in memory, and a coat into bytes: no file is touched.
#include <pelage/grow.h>
#include <pelage/io.h>

#include <iostream>

int main() try {
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 2 4\n";
  const pelage::ShapeFile file = pelage::read_shape_bytes(tetrahedron, "upload.obj");
  for (const pelage::Finding& finding : file.findings)
    std::cout << (finding.repaired ? "repaired: " : "noted: ") << finding.text << "\n";

  pelage::Recipe recipe;
  recipe.stages[0].size = pelage::Given<pelage::Length>{{0.3}, {}};
  recipe.stages[0].steps = 20;
  recipe.look.detail = 0;
  const std::string glb = pelage::mesh_bytes(pelage::grow(file.mesh, recipe), ".glb");
  std::cout << glb.size() << " bytes of glTF\n";
  return glb.starts_with("glTF") ? 0 : 1;
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
