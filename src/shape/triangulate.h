#pragma once
// Faces of any number of corners -> triangles.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelage/polygon_mesh.h"
#include "shape/finding.h"

namespace pelage {

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
