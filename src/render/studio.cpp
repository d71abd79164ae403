#include "render/studio.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/frame.h"

namespace pelage {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

const Vector3f wall(0.30F, 0.31F, 0.33F), ceiling(0.53F, 0.55F, 0.57F);

/// The part of the room's light that still arrives after two bounces, as a share of a white surface: without it
/// creases would go black. A guess that is right for the middle of a matt half-closed hollow.
constexpr float remaining_light = 0.22F;

/// Turned from the camera's direction by an angle to the right, at an angle above the floor.
Vector3f lamp_direction(const Vector3f& back, float right_degrees, float up_degrees) {
  const float a = std::atan2(back.x(), back.z()) + right_degrees * pi / 180, e = up_degrees * pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

// The octahedral map (Meyer et al., "On Floating-Point Normal Vectors", 2010): directions to [-1, 1]^2, the upper
// hemisphere to the square inside that stands on its corner, the lower one folded out into the four corners.
constexpr int cells = 32;  // per side; irradiance is smooth

Vector2f fold(float x, float z) { return {std::copysign(1 - std::abs(z), x), std::copysign(1 - std::abs(x), z)}; }

Vector2f to_octahedral(const Vector3f& n) {
  const Vector3f p = n / n.lpNorm<1>();
  return p.y() >= 0 ? Vector2f(p.x(), p.z()) : fold(p.x(), p.z());
}

Vector3f from_octahedral(const Vector2f& p) {
  const float y = 1 - p.lpNorm<1>();
  const Vector2f q = y >= 0 ? p : fold(p.x(), p.y());
  return Vector3f(q.x(), y, q.y()).normalized();
}

/// Directions in the middles of equal steps of longitude and latitude, none on the horizon, with their solid angles.
std::vector<std::pair<Vector3f, float>> sphere_points() {
  constexpr int around = 64, down = 32;
  std::vector<std::pair<Vector3f, float>> points;
  for (int i = 0; i < down; ++i)
    for (int j = 0; j < around; ++j) {
      const float latitude = pi * (static_cast<float>(i) + 0.5F) / down;
      const float longitude = 2 * pi * (static_cast<float>(j) + 0.5F) / around;
      const float radius = std::sin(latitude);
      points.emplace_back(Vector3f(radius * std::cos(longitude), std::cos(latitude), radius * std::sin(longitude)),
                          radius);
    }
  return points;
}

/// Mean over the unit disc of max(0, a + b x), b > 0.
float clipped_mean(float a, float b) {
  const float t = a / b;
  if (t >= 1) return a;
  if (t <= -1) return 0;
  const float root = std::sqrt(1 - t * t);
  return b * 2 / pi * (t * (pi / 4 + (t * root + std::asin(t)) / 2) + root * root * root / 3);
}

}  // namespace

Studio::Studio(const Vector3f& back, const Vector3f& paper, const PictureLamp& lamp)
    : key_(0.62F, 0.605F, 0.585F),  // a little warmer than the room, as tungsten against daylight
      paper_(paper),
      to_key_(lamp_direction(back, static_cast<float>(lamp.azimuth), static_cast<float>(lamp.elevation))),
      to_rim_(lamp_direction(back, 140, 30)),
      back_(back),
      lamp_radius_(static_cast<float>(lamp.size)) {
  const Frame around(to_key_);
  key_x_ = around.x, key_y_ = around.y;
  // Exact for polynomials of degree 5 over the disc (Abramowitz and Stegun 25.4.61): the middle and a hexagon.
  key_points_[0] = {to_key_, 0.25F};
  for (std::size_t k = 1; k < 7; ++k) key_points_[k] = {key_direction({2.0F / 3, static_cast<float>(k) / 6}), 0.125F};
  floor_ = bounced(paper_, key_cosine(Vector3f::UnitY()));
  tabulate();
}

void Studio::tabulate() {
  const auto points = sphere_points();
  std::vector<Vector3f> light;
  for (const auto& [direction, angle] : points) light.push_back(angle * open(direction));
  irradiance_.resize((cells + 1) * (cells + 1));
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const Vector3f n = from_octahedral(Vector2f(j, i) * 2 / cells - Vector2f::Ones());
      Vector3f sum = Vector3f::Zero();
      float weights = 0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const float cosine = std::max(0.0F, n.dot(points[k].first));
        sum += cosine * light[k];
        weights += cosine * points[k].second;
      }
      irradiance_[static_cast<std::size_t>(i * (cells + 1) + j)] = sum / weights;
    }
}

Vector3f Studio::open_irradiance(const Vector3f& n) const {
  const Vector2f p = (to_octahedral(n) + Vector2f::Ones()) * cells / 2;
  const int j = std::clamp(static_cast<int>(p.x()), 0, cells - 1),
            i = std::clamp(static_cast<int>(p.y()), 0, cells - 1);
  const float u = p.x() - static_cast<float>(j), v = p.y() - static_cast<float>(i);
  const Vector3f* upper = &irradiance_[static_cast<std::size_t>(i * (cells + 1) + j)];
  const Vector3f* lower = upper + cells + 1;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

Vector3f Studio::key_direction(const std::array<float, 2>& random) const {
  const Vector2f p = lamp_radius_ * disc_point(random);
  return (to_key_ + p.x() * key_x_ + p.y() * key_y_).normalized();
}

float Studio::key_density(const Vector3f& direction) const { return density_of_disc(direction, lamp_radius_); }

/// Over the sphere, of directions to even points of a lamp of that radius.
float Studio::density_of_disc(const Vector3f& direction, float radius) const {
  const float d = direction.dot(to_key_);
  if (d <= 0 || (direction / d - to_key_).squaredNorm() > radius * radius) return 0;
  return 1 / (pi * radius * radius * d * d * d);
}

Vector3f Studio::lamp(const Vector3f& direction) const { return pi * key_density(direction) * key_; }

Vector3f Studio::wide_lamp(const Vector3f& direction) const {
  return pi * density_of_disc(direction, 3 * lamp_radius_) * key_;
}

Vector3f Studio::surroundings(const Vector3f& direction) const {
  const float behind = smooth_step(0.1F, 0.6F, -direction.dot(back_)) * smooth_step(0.9F, 0.5F, direction.y());
  return room(direction) + behind * (paper_ - room(direction));
}

Vector3f Studio::seen_floor(bool lit) const {
  if (lit) return paper_;
  const Vector3f room = floor_irradiance(), all = room + key_cosine(Vector3f::UnitY()) * key_;
  return paper_.cwiseProduct(room.cwiseQuotient(all));
}

float Studio::key_cosine(const Vector3f& n) const {
  // The flat lamp's points are to_key + p with |p| <= r, their distances sqrt(1 + p^2): 2 (sqrt(1 + r^2) - 1) / r^2 is
  // the mean of 1 / distance.
  const float r = lamp_radius_;
  const float nearness = 2 * (std::sqrt(1 + r * r) - 1) / (r * r);
  const float a = n.dot(to_key_);
  const float b = r * std::sqrt(std::max(1e-6F, n.squaredNorm() - a * a));
  return nearness * clipped_mean(a, b);
}

Vector3f Studio::bounced(const Vector3f& color, float key_cosine) const {
  return color.cwiseProduct(Vector3f::Constant(remaining_light) + key_cosine * key_);
}

Vector3f Studio::walls(const Vector3f& direction) const {
  return wall + std::clamp(direction.y(), 0.0F, 1.0F) * (ceiling - wall);
}

Vector3f Studio::room(const Vector3f& direction) const {
  const float rim = smooth_step(0.80F, 0.97F, direction.dot(to_rim_));
  return walls(direction) + Vector3f::Constant(1.6F * rim);
}

Vector3f Studio::floor_irradiance() const { return wall + 2.0F / 3 * (ceiling - wall); }

float Studio::backdrop(float x, float y) const {
  // Brightest around the object, falling off to the corners and a little more towards the top.
  return 1 - (0.16F * (x * x + y * y) + 0.05F * y);
}

Vector2f disc_point(const std::array<float, 2>& random) {
  const float radius = std::sqrt(random[0]), angle = 2 * pi * random[1];
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vector3f hemisphere_direction(const Vector3f& n, const Vector2f& p) {
  return Frame(n).to_world({p.x(), p.y(), std::sqrt(std::max(0.0F, 1 - p.squaredNorm()))}).normalized();
}

Vector3f cosine_direction(const Vector3f& n, const std::array<float, 2>& random) {
  return hemisphere_direction(n, disc_point(random));
}

}  // namespace pelage
