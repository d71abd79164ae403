#pragma once
// The light of the pictures: a photographer's table. A large soft key lamp above the left shoulder of the camera, a
// bright ceiling, a weaker rim lamp behind the object, and a paper backdrop that runs from the floor up the wall.

#include <Eigen/Core>
#include <array>

namespace pelage {

/// All radiances are such that a white, matt surface that faces the key lamp is close to 1.
class Studio {
 public:
  /// The lamps turn with the camera; `back` points from the object to it, y is up. `paper` is the colour of the
  /// backdrop in linear light.
  Studio(const Eigen::Vector3f& back, const Eigen::Vector3f& paper);

  /// A direction towards a point of the key lamp for a random point of the unit square.
  Eigen::Vector3f key_direction(const std::array<float, 2>& random) const;
  /// Irradiance of a surface that faces the key lamp, divided by pi.
  const Eigen::Vector3f& key() const { return key_; }
  /// Radiance that comes from the room (ceiling, walls, rim lamp) in an upward direction.
  Eigen::Vector3f room(const Eigen::Vector3f& direction) const;
  /// Colour of the paper, lit and without shadow, at a place of the picture with both coordinates in [-1, 1].
  Eigen::Vector3f backdrop(float x, float y) const;
  const Eigen::Vector3f& paper() const { return paper_; }

 private:
  Eigen::Vector3f key_, paper_;
  Eigen::Vector3f to_key_, to_rim_, key_x_, key_y_;
};

/// Direction with density cos / pi around the unit vector n (Malley's method).
Eigen::Vector3f cosine_direction(const Eigen::Vector3f& n, const std::array<float, 2>& random);

}  // namespace pelage
