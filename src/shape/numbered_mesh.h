#pragma once
// A mesh while it is being repaired: faces and vertices go, their first numbers and their attributes follow.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

struct NumberedMesh {
  TriangleMesh mesh;
  std::vector<std::int32_t> vertex_number;  ///< per vertex: its number in the messages (that of the file)
  std::vector<std::int32_t> face_number;    ///< per triangle: likewise
};

/// Keeps the triangles with keep[f] != 0, in their order.
void keep_faces(NumberedMesh& work, const std::vector<char>& keep);

/// New vertex i becomes a copy of old vertex source[i]. The triangles are left as they are.
void gather_vertices(NumberedMesh& work, const std::vector<std::int32_t>& source);

/// Reverses the triangles with flip[f] != 0: the last two corners change places.
void flip_faces(TriangleMesh& mesh, const std::vector<char>& flip);

/// Removes the vertices that no triangle uses, with the order of the others kept. Returns the number that the
/// first of them had, and how many there were.
struct Dropped {
  std::size_t count = 0;
  std::size_t first = 0;
};
Dropped drop_unused_vertices(NumberedMesh& work);

}  // namespace pelage
