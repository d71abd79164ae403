#pragma once
// Directions around a normal.

#include <Eigen/Core>
#include <cmath>

namespace pelage {

/// A right-handed frame whose third axis is a unit vector (Duff et al., "Building an Orthonormal Basis, Revisited",
/// JCGT 2017).
struct Frame {
  explicit Frame(const Eigen::Vector3f& normal) : n(normal) {
    const float sign = std::copysign(1.0F, n.z());
    const float a = -1 / (sign + n.z());
    const float b = n.x() * n.y() * a;
    x = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
    y = {b, sign + n.y() * n.y() * a, -n.y()};
  }

  Eigen::Vector3f to_local(const Eigen::Vector3f& v) const { return {x.dot(v), y.dot(v), n.dot(v)}; }
  Eigen::Vector3f to_world(const Eigen::Vector3f& v) const { return v.x() * x + v.y() * y + v.z() * n; }

  Eigen::Vector3f x, y, n;
};

}  // namespace pelage
