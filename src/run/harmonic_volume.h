#pragma once
// The nodes of a volume whose surface moves.

#include <memory>
#include <vector>

#include "linalg/sparse.h"
#include "pelage/tet_mesh.h"
#include "shape/mesh_place.h"

namespace pelage {

class HarmonicVolume {
 public:
  /// `surface`: a manifold that the skin of the volume lies on; `stiffness`: of linear elements between its nodes.
  HarmonicVolume(std::shared_ptr<const TetMesh> volume, std::shared_ptr<const TriangleMesh> surface,
                 SharedMatrix stiffness);

  /// Where the nodes are when the vertices of the surface are at `surface` [world units]. Those of the skin have gone
  /// as far as the place of the surface that was nearest to them; inside, each coordinate of the displacement is the
  /// discrete harmonic function of these, of the volume as it was at first, so that the way there does not matter.
  /// Error(Fault::numerics) where a tetrahedron is turned inside out.
  std::vector<Point> points(const std::vector<Point>& surface) const;

 private:
  void require_upright(const std::vector<Point>& points) const;

  std::shared_ptr<const TetMesh> volume_;
  std::shared_ptr<const TriangleMesh> surface_;
  SharedMatrix stiffness_;
  std::vector<char> skin_;          ///< per node
  std::vector<MeshPlace> nearest_;  ///< per node of the skin
};

}  // namespace pelage
