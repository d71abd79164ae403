#include "render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pelage/render.h"

namespace pelage {

namespace {

/// How far the points reach against the two side planes of a pyramid of view, along one axis of the picture.
struct Reach {
  float plus = std::numeric_limits<float>::lowest();   // largest  x + t z
  float minus = std::numeric_limits<float>::lowest();  // largest -x + t z

  void add(float x, float tz) {
    plus = std::max(plus, x + tz);
    minus = std::max(minus, -x + tz);
  }
  float middle() const { return (plus - minus) / 2; }
  float distance(float t) const { return (plus + minus) / (2 * t); }
};

}  // namespace

Eigen::Vector3f Camera::direction(float x, float y) const {
  return (right * (x * tan_x) + up * (y * tan_y) - back).normalized();
}

Eigen::Vector2f Camera::project(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f offset = point - position;
  const float depth = -offset.dot(back);
  if (!(depth > 0)) return Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
  return {offset.dot(right) / (depth * tan_x), offset.dot(up) / (depth * tan_y)};
}

namespace {

constexpr double radian = std::numbers::pi / 180;

/// The longer side of the picture sees the angle.
void set_lens(Camera& camera, double aspect, double angle_degrees) {
  const double tangent = std::tan(angle_degrees / 2 * radian);
  camera.tan_x = static_cast<float>(tangent * std::min(1.0, aspect));
  camera.tan_y = static_cast<float>(tangent / std::max(1.0, aspect));
}

}  // namespace

std::vector<Eigen::Vector3f> swept_around(const std::vector<Eigen::Vector3f>& points, double azimuth_degrees) {
  constexpr int slices = 64, around = 72;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : points) box.extend(p);
  const Eigen::Vector3f middle = box.center();
  const float height = std::max(box.sizes().y(), std::numeric_limits<float>::min()) / slices;
  std::vector<float> radius(slices, -1);
  for (const Eigen::Vector3f& p : points) {
    const int slice = std::min(static_cast<int>((p.y() - box.min().y()) / height), slices - 1);
    radius[slice] = std::max(radius[slice], Eigen::Vector2f(p.x() - middle.x(), p.z() - middle.z()).norm());
  }
  std::vector<Eigen::Vector3f> rings;
  for (int edge = 0; edge <= slices; ++edge) {  // between two slices, as wide as the wider one
    const float r = std::max(radius[std::max(edge - 1, 0)], radius[std::min(edge, slices - 1)]);
    for (int k = 0; r >= 0 && k < around; ++k) {
      const auto a = static_cast<float>(azimuth_degrees * radian + 2 * std::numbers::pi * k / around);
      rings.emplace_back(middle.x() + r * std::sin(a), box.min().y() + static_cast<float>(edge) * height,
                         middle.z() + r * std::cos(a));
    }
  }
  return rings;
}

double angle_of_lens(double millimetres) {
  constexpr double film = 36;  // mm, the longer side of 35 mm film
  return 2 / radian * std::atan(film / (2 * millimetres));
}

Camera placed_camera(const Eigen::Vector3f& position, const Eigen::Vector3f& towards, const Eigen::Vector3f& up,
                     double aspect, double angle_degrees) {
  Camera camera;
  camera.position = position;
  camera.back = -towards.normalized();
  camera.right = up.cross(camera.back).normalized();
  camera.up = camera.back.cross(camera.right);
  set_lens(camera, aspect, angle_degrees);
  return camera;
}

Camera frame_points(const std::vector<Eigen::Vector3f>& points, double azimuth_degrees, double elevation_degrees,
                    double aspect, double margin, double angle_degrees) {
  const auto a = static_cast<float>(azimuth_degrees * radian), e = static_cast<float>(elevation_degrees * radian);
  Camera camera;
  camera.back = {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
  camera.right = {std::cos(a), 0, -std::sin(a)};
  camera.up = camera.back.cross(camera.right);
  set_lens(camera, aspect, angle_degrees);
  const auto inner = static_cast<float>(1 - 2 * margin);
  // A point p is inside if |p.x - c.x| <= t (c.z - p.z) in camera axes: two linear bounds per axis on c.
  Reach x, y;
  for (const Eigen::Vector3f& p : points) {
    const float depth = p.dot(camera.back);
    x.add(p.dot(camera.right), inner * camera.tan_x * depth);
    y.add(p.dot(camera.up), inner * camera.tan_y * depth);
  }
  const float distance = std::max(x.distance(inner * camera.tan_x), y.distance(inner * camera.tan_y));
  camera.position = camera.right * x.middle() + camera.up * y.middle() + camera.back * distance;
  return camera;
}

}  // namespace pelage
