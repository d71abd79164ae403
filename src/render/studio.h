#pragma once
// The light of the pictures: a photographer's table. A large soft key lamp above the left shoulder of the camera, a
// bright ceiling, a weaker rim lamp behind the object, and a paper backdrop that runs from the floor up the wall.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pelage/render.h"

namespace pelage {

/// All radiances are such that a white, matt surface that faces the key lamp is close to 1.
class Studio {
 public:
  /// The lamps turn with the camera; `back` points from the object to it, y is up. `paper` is the colour of the
  /// backdrop in linear light.
  Studio(const Eigen::Vector3f& back, const Eigen::Vector3f& paper, const PictureLamp& lamp = {});

  /// A direction towards a point of the key lamp for a random point of the unit square.
  Eigen::Vector3f key_direction(const std::array<float, 2>& random) const;
  /// Its density over the sphere, 0 beside the lamp.
  float key_density(const Eigen::Vector3f& direction) const;
  /// Directions and weights whose weighted sum over a smooth function is its mean over the key lamp.
  struct LampPoint {
    Eigen::Vector3f direction;
    float weight;
  };
  const std::array<LampPoint, 7>& key_points() const { return key_points_; }
  /// The cosine at a surface with unit normal n, zero behind its horizon, as a mean over the key lamp.
  float key_cosine(const Eigen::Vector3f& n) const;
  /// Irradiance of a surface that faces the key lamp, divided by pi.
  const Eigen::Vector3f& key() const { return key_; }
  /// Radiance that comes from ceiling and walls in an upward direction, and from all of the room: with the rim lamp.
  Eigen::Vector3f walls(const Eigen::Vector3f& direction) const;
  Eigen::Vector3f room(const Eigen::Vector3f& direction) const;
  /// Irradiance of the floor by ceiling and walls, over pi. The rim lamp is shaded towards the floor: it would throw a
  /// second shadow, at the viewer.
  Eigen::Vector3f floor_irradiance() const;
  /// What a matt surface sends on to another one; `key_cosine` is that at the visible part of the key lamp.
  Eigen::Vector3f bounced(const Eigen::Vector3f& color, float key_cosine) const;
  /// Radiance from any direction when there is no object: the room, or the floor where the key lamp lights it.
  Eigen::Vector3f open(const Eigen::Vector3f& direction) const { return direction.y() >= 0 ? room(direction) : floor_; }
  /// The mean of `open` with density cos / pi around n: irradiance over pi. Tabulated, to within 0.3 %.
  Eigen::Vector3f open_irradiance(const Eigen::Vector3f& n) const;
  /// Brightness of the paper, lit and without shadow, at a place of the picture with both coordinates in [-1, 1]: its
  /// share of the paper's colour.
  float backdrop(float x, float y) const;
  const Eigen::Vector3f& paper() const { return paper_; }
  /// Radiance that comes from a direction as things that mirror or refract show it: the lamp, the room and, behind the
  /// object, the paper, which hangs down from above. Upwards only.
  Eigen::Vector3f lamp(const Eigen::Vector3f& direction) const;
  Eigen::Vector3f wide_lamp(const Eigen::Vector3f& direction) const;  ///< as much light from nine times the area
  Eigen::Vector3f surroundings(const Eigen::Vector3f& direction) const;
  /// The floor as the camera sees it.
  Eigen::Vector3f seen_floor(bool lit) const;

 private:
  void tabulate();
  float density_of_disc(const Eigen::Vector3f& direction, float radius) const;

  Eigen::Vector3f key_, paper_, floor_;
  Eigen::Vector3f to_key_, to_rim_, key_x_, key_y_, back_;
  float lamp_radius_;
  std::array<LampPoint, 7> key_points_;
  std::vector<Eigen::Vector3f> irradiance_;  ///< over the octahedral map of directions
};

/// Direction with density cos / pi around the unit vector n (Malley's method).
Eigen::Vector3f cosine_direction(const Eigen::Vector3f& n, const std::array<float, 2>& random);

/// The same for a point of the unit disc, of which it is the projection along n.
Eigen::Vector3f hemisphere_direction(const Eigen::Vector3f& n, const Eigen::Vector2f& disc);

/// Uniform in the unit disc for a random point of the unit square.
Eigen::Vector2f disc_point(const std::array<float, 2>& random);

}  // namespace pelage
