#pragma once
// Shoots rays from places on the object and on the floor to the key lamp and into the room.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "render/ray_scene.h"
#include "render/smooth_light.h"
#include "render/studio.h"

namespace pelage {

/// Random numbers of one light sample, as directions.
struct LightSample {
  Eigen::Vector3f to_key, to_second_key;
  Eigen::Vector2f bounce;  ///< in the unit disc
};

/// Samples of light for the places of a grid: those of neighbours are spread evenly.
class LightSamples {
 public:
  explicit LightSamples(const Studio& studio);

  /// Sample `k` below `count` of the place (column, row).
  const LightSample& operator()(int column, int row, std::uint32_t count, std::uint32_t k) const;

 private:
  std::vector<LightSample> samples_;
};

/// All queries may run on several threads at once. They add one sample to a light and return the square of how much the
/// object changes it, as a share.
class LightTracer {
 public:
  /// `pixel_size`: of a pixel at the object, in which closeness is measured.
  LightTracer(const RayScene& scene, const Studio& studio, float pixel_size)
      : scene_(scene), studio_(studio), pixel_size_(pixel_size) {}

  /// The key lamp at a place that is seen in a direction.
  float add_lamp(const SurfacePoint& point, const Eigen::Vector3f& direction, const LightSample& sample,
                 Light& light) const;
  /// The room, the floor and the object itself.
  float add_room(const SurfacePoint& point, const LightSample& sample, Light& light) const;
  /// The same on the floor, which the rim lamp does not light.
  float add_floor_room(const SurfacePoint& point, const LightSample& sample, Light& light) const;

 private:
  struct Sender {
    Eigen::Vector3f radiance;
    float distance = std::numeric_limits<float>::infinity();
  };
  Sender sender_of(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, const LightSample& sample) const;
  float closeness(float distance) const;

  const RayScene& scene_;
  const Studio& studio_;
  float pixel_size_;
};

/// A place on the floor, where rays start a little above.
SurfacePoint floor_point(const Eigen::Vector3f& place);

}  // namespace pelage
