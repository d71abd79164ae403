// Uses an installed pelage from outside its source tree.

#include <pelage/error.h>
#include <pelage/triangle_mesh.h>

#include <iostream>

int main() {
  try {
    pelage::TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.set({"height", 1, pelage::Domain::vertex, {0, 0, 1}});
    const pelage::Attribute* height = mesh.find("height");
    if (height == nullptr || height->values.size() != mesh.points.size())
      throw pelage::Error(pelage::Fault::input, "the attribute \"height\" was lost", {"triangle", 1});
    std::cout << mesh.triangles.size() << " triangle, height of its last corner " << height->values.back() << "\n";
    return 0;
  } catch (const pelage::Error& error) {
    std::cerr << "outside: error: " << error.what() << "\n";
    return static_cast<int>(error.fault());
  }
}
