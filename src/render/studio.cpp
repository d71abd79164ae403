#include "render/studio.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al., "Building an Orthonormal
/// Basis, Revisited", JCGT 2017).
void make_frame(const Vector3f& n, Vector3f& x, Vector3f& y) {
  const float sign = std::copysign(1.0F, n.z());
  const float a = -1 / (sign + n.z());
  const float b = n.x() * n.y() * a;
  x = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
  y = {b, sign + n.y() * n.y() * a, -n.y()};
}

Vector2f disc_point(const std::array<float, 2>& random) {
  const float radius = std::sqrt(random[0]), angle = 2 * pi * random[1];
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Turned from the camera's direction by an angle to the right, at an angle above the floor.
Vector3f lamp_direction(const Vector3f& back, float right_degrees, float up_degrees) {
  const float a = std::atan2(back.x(), back.z()) + right_degrees * pi / 180, e = up_degrees * pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace

Studio::Studio(const Vector3f& back, const Vector3f& paper)
    : key_(0.62F, 0.605F, 0.585F),  // a little warmer than the room, as tungsten against daylight
      paper_(paper),
      to_key_(lamp_direction(back, -42, 48)),
      to_rim_(lamp_direction(back, 140, 30)) {
  make_frame(to_key_, key_x_, key_y_);
}

Vector3f Studio::key_direction(const std::array<float, 2>& random) const {
  constexpr float radius = 0.30F;  // of a lamp at distance 1: shadows with wide soft edges
  const Vector2f p = radius * disc_point(random);
  return (to_key_ + p.x() * key_x_ + p.y() * key_y_).normalized();
}

Vector3f Studio::room(const Vector3f& direction) const {
  const Vector3f wall(0.30F, 0.31F, 0.33F), ceiling(0.53F, 0.55F, 0.57F);
  const float height = std::clamp(direction.y(), 0.0F, 1.0F);
  const float rim = smooth_step(0.80F, 0.97F, direction.dot(to_rim_));
  return wall + height * (ceiling - wall) + Vector3f::Constant(1.6F * rim);
}

Vector3f Studio::backdrop(float x, float y) const {
  // Brightest around the object, falling off to the corners and a little more towards the top.
  const float fall = 0.16F * (x * x + y * y) + 0.05F * y;
  return paper_ * (1 - fall);
}

Vector3f cosine_direction(const Vector3f& n, const std::array<float, 2>& random) {
  Vector3f x, y;
  make_frame(n, x, y);
  const Vector2f p = disc_point(random);
  return (p.x() * x + p.y() * y + std::sqrt(std::max(0.0F, 1 - p.squaredNorm())) * n).normalized();
}

}  // namespace pelage
