#pragma once
// A triangle mesh that rays can be shot at (Embree).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// What is seen of the surface. Normals point to the side that the ray comes from.
struct Skin {
  Eigen::Vector3f face_normal;
  Eigen::Vector3f normal;  ///< interpolated, or the face's
  Eigen::Vector3f color;   ///< linear
};

/// Where a ray meets the surface.
struct SurfacePoint : Skin {
  Eigen::Vector3f position;
  Eigen::Vector3f lifted;  ///< a start for further rays: on the smooth surface that the shading normals imply
};

struct Hit {
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t triangle = nothing;
  float u = 0, v = 0;  ///< weights of the triangle's second and third corner
};

/// Immutable after construction; all queries may run on several threads at once.
class RayScene {
 public:
  /// `points` replace those of the mesh (turned and scaled so that the object's size is about 1); `rotation` turns
  /// its normals. Colours and normals are taken from "color" and "normal" if these sit at the vertices. `report` is
  /// called with the fraction done and may return false: Error(Fault::cancelled).
  RayScene(const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& points, const Eigen::Matrix3f& rotation,
           const std::function<bool(double)>& report = {});
  ~RayScene();

  /// Rays in a narrow bundle, traced together: faster than one by one. At most `widest_bundle`.
  static constexpr std::size_t widest_bundle = 16;
  void intersect(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions, std::span<Hit> hits) const;
  std::optional<SurfacePoint> intersect(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  bool occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  /// How far the surface is, infinite if it is not met.
  float distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  Eigen::Vector3f position(const Hit& hit) const;
  /// What a ray of this direction found at a hit.
  Skin skin(const Eigen::Vector3f& direction, const Hit& hit) const;
  SurfacePoint surface_point(const Skin& skin, const Hit& hit) const;

 private:
  struct Embree;

  std::unique_ptr<Embree> embree_;
  std::vector<Eigen::Vector3f> points_, normals_, colors_;  // normals and colours may be empty
  std::vector<Triangle> triangles_;
};

}  // namespace pelage
