#pragma once
// Another mesh of the same shape, a coarser one for example, which is to show a coat: each of its places shows the
// nearest one of the coat's surface.

#include "look/tessellation.h"
#include "shape/locate.h"

namespace pelage {

/// Triangles of such a mesh that are nowhere near the coat.
struct FarTriangles {
  std::size_t count = 0;
  Index first = 0;
  double furthest = 0;  ///< of all triangles [world units]
};

class OntoMesh {
 public:
  /// Keeps references to both.
  OntoMesh(const TriangleMesh& mesh, const Tessellation& coat);

  /// The place of the coat's triangles that is nearest to a place of the mesh, among those that do not face away from
  /// its triangle, so that thin parts do not take the other side; beyond a triangle its plane goes on. What two
  /// triangles show of their edge is the same, but where the coat faces away from one of them. `near`: a triangle of
  /// the coat that is likely near, for speed alone. Thread-safe.
  MeshPlace on_coat(const MeshPlace& place, Index near = -1) const;

  /// Those whose corners, middles of edges or middle are farther than `distance` from what they show.
  FarTriangles farther_than(double distance) const;

 private:
  const TriangleMesh& mesh_;
  const SurfaceWalk coat_;
};

}  // namespace pelage
