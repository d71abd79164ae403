#pragma once
// Functions that are linear on the triangles of a surface: values and slopes, piece by piece and in the mean.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "discretise/space.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// A triangle with the values at its corners.
struct Piece {
  Eigen::Matrix3d corner;  ///< columns
  Eigen::Vector3d value;

  Eigen::Vector3d doubled_area() const;  ///< along the normal
  double area() const { return doubled_area().norm() / 2; }
  /// 0 without area.
  Eigen::Vector3d gradient() const;
};

Piece piece_of(const TriangleMesh& mesh, const std::vector<double>& values, const Triangle& t);

/// Linear elements on a surface. Error(Fault::input) for meshes that are no manifold.
std::shared_ptr<const Space> linear_space(const TriangleMesh& mesh);

/// g g' of the slopes g around every vertex: the means over Gaussians, by a step of diffusion.
std::vector<Eigen::Matrix3d> slope_tensors(const Space& space, const TriangleMesh& mesh,
                                           const std::vector<double>& values, double sigma);

/// Of every vertex, the sum over its triangles of twice their area, along their normals.
std::vector<Eigen::Vector3d> area_normals(const TriangleMesh& mesh);

}  // namespace pelage
