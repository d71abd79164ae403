#pragma once
// A triangle mesh that rays can be shot at (Embree).

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Where a ray meets the surface. Normals point to the side that the ray comes from.
struct SurfacePoint {
  Eigen::Vector3f position;
  Eigen::Vector3f lifted;  ///< a start for further rays: on the smooth surface that the shading normals imply
  Eigen::Vector3f face_normal;
  Eigen::Vector3f normal;  ///< interpolated, or the face's
  Eigen::Vector3f color;   ///< linear
};

/// Immutable after construction; all queries may run on several threads at once.
class RayScene {
 public:
  /// `points` replace those of the mesh (turned and scaled so that the object's size is about 1); `rotation` turns
  /// its normals. Colours and normals are taken from "color" and "normal" if these sit at the vertices.
  RayScene(const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& points, const Eigen::Matrix3f& rotation);
  ~RayScene();

  std::optional<SurfacePoint> intersect(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  bool occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

 private:
  struct Embree;
  SurfacePoint surface_point(const Eigen::Vector3f& direction, std::uint32_t triangle, float u, float v) const;

  std::unique_ptr<Embree> embree_;
  std::vector<Eigen::Vector3f> points_, normals_, colors_;  // normals and colours may be empty
  std::vector<Triangle> triangles_;
};

}  // namespace pelage
