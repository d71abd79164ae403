#pragma once
// Faces of any number of corners -> triangles.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/finding.h"

namespace pelage {

/// A mesh as the files have it: faces with any number of corners, not yet checked.
struct PolygonMesh {
  std::vector<Point> points;
  std::vector<std::int32_t> corners;   ///< vertex numbers of face after face
  std::vector<std::size_t> face_ends;  ///< face f has the corners from face_ends[f-1] (0 for f = 0) to face_ends[f]
  std::vector<Attribute> attributes;   ///< Domain::corner: one tuple per entry of `corners`

  std::size_t face_count() const { return face_ends.size(); }
  std::size_t face_begin(std::size_t f) const { return f == 0 ? 0 : face_ends[f - 1]; }
  /// Closes the face whose corners were appended to `corners`.
  void end_face() { face_ends.push_back(corners.size()); }
};

struct Triangulation {
  TriangleMesh mesh;
  std::vector<std::int32_t> source_face;  ///< for each triangle the face that it was cut from
};

/// Cuts every face into triangles of its own orientation, in the order of the faces: quads along the diagonal
/// whose worst angle is better, larger faces by clipping the best ear (Meisters 1975) in the plane of the
/// face's mean normal; so concave faces do not fold over. Faces with fewer than three corners are left out
/// and reported, as are faces that cross themselves.
/// Throws ShapeFault for vertex numbers out of range, faces of more than 20000 corners (the time grows with
/// the square of the corners) and more than 715827882 triangles (corner numbers have 31 bits).
Triangulation triangulate(PolygonMesh polygons, std::vector<Finding>& findings);

}  // namespace pelage
