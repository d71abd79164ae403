#pragma once
// The nodes of a volume whose surface moves.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "linalg/harmonic.h"
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
  /// Where a tetrahedron would lose nearly all of its volume or turn inside out, its nodes go with those around it
  /// instead. Error(Fault::numerics) where that does not help.
  std::vector<Point> points(const std::vector<Point>& surface) const;

 private:
  using Displacements = std::vector<Eigen::Vector3d>;  ///< per node [world units]
  Displacements displacements(const std::vector<Point>& surface) const;
  void spread(Displacements& displacement) const;
  /// Nodes with a reach have the mean of the corners of their tetrahedra.
  Displacements averaged(const Displacements& displacement, const std::vector<int>& reach) const;
  /// Per node, whether a tetrahedron at it is crushed by these displacements; empty where none is.
  std::vector<char> crushed(const Displacements& displacement) const;
  Point moved(std::size_t node, const Displacements& displacement) const;

  std::shared_ptr<const TetMesh> volume_;
  std::shared_ptr<const TriangleMesh> surface_;
  HarmonicFunctions inside_;        ///< held at the nodes of the skin
  std::vector<MeshPlace> nearest_;  ///< per node of the skin
};

}  // namespace pelage
