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
#include "render/finish.h"

namespace pelage {

/// What is seen of the surface. Normals point to the side that the ray comes from.
struct Skin {
  Eigen::Vector3f face_normal;
  Eigen::Vector3f normal;  ///< interpolated, or the face's; tilted where the mesh has heights
  Eigen::Vector3f color;   ///< linear
};

struct Hit {
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t triangle = nothing;
  float u = 0, v = 0;  ///< weights of the triangle's second and third corner
};

/// Where a ray meets the surface.
struct SurfacePoint : Skin {
  Eigen::Vector3f position;
  Eigen::Vector3f lifted;  ///< a start for further rays: on the smooth surface that the normals imply without heights
  Hit hit = {};
};

/// Immutable after construction; all queries may run on several threads at once.
class RayScene {
 public:
  /// `points` replace those of the mesh (turned and scaled so that the object's size is about 1); `rotation` turns
  /// its normals. Colours, normals and what pelage/channel.h names are taken from the attributes at the vertices;
  /// `scale`: of lengths among these. `report` is called with the fraction done and may return false:
  /// Error(Fault::cancelled).
  RayScene(const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& points, const Eigen::Matrix3f& rotation,
           const std::function<bool(double)>& report = {}, float scale = 1);
  ~RayScene();

  /// Rays in a narrow bundle, traced together: faster than one by one. At most `widest_bundle`.
  static constexpr std::size_t widest_bundle = 16;
  void intersect(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions, std::span<Hit> hits) const;
  std::optional<SurfacePoint> meet(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  // What stops light: glass and what is not opaque does so in parts, spread evenly.
  std::optional<SurfacePoint> intersect(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  bool occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  /// How far the surface is, infinite if it is not met.
  float distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  Eigen::Vector3f position(const Hit& hit) const;
  /// What a ray of this direction found at a hit.
  Skin skin(const Eigen::Vector3f& direction, const Hit& hit) const;
  SurfacePoint surface_point(const Skin& skin, const Hit& hit) const;
  /// Whether the mesh says no more of its material than colours and heights.
  bool plain() const { return finishes_.empty(); }
  Finish finish(const Hit& hit) const;
  /// Whether the ray met the surface on its inner side.
  bool from_behind(const Eigen::Vector3f& direction, const Hit& hit) const;

 private:
  struct Embree;
  struct Met;

  Met first_blocking(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  bool blocks(const Hit& hit) const;
  Eigen::Vector3f flat_normal(const Hit& hit) const;
  Eigen::Vector3f shading_normal(const Hit& hit) const;

  std::unique_ptr<Embree> embree_;
  std::vector<Eigen::Vector3f> points_, normals_, colors_;  // normals and colours may be empty
  std::vector<Eigen::Vector3f> tilted_;                     // normals, where the mesh has heights
  std::vector<Finish> finishes_;                            // empty: plain
  bool see_through_ = false;
  std::vector<Triangle> triangles_;
};

}  // namespace pelage
