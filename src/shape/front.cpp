#include "shape/front.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"

namespace pelage {

namespace {

using Eigen::Vector3d;

constexpr std::size_t most_samples = 1 << 15;
constexpr int step = 5;  // degrees between mirrors that are tried

Vector3d upright(const Point& p, UpAxis up) {
  return up == UpAxis::y ? Vector3d(p[0], p[1], p[2]) : Vector3d(p[0], p[2], -p[1]);
}

/// Points spread evenly over the surface, about their middle, in units of the shape's size.
std::vector<Vector3d> spread_points(const TriangleMesh& mesh, UpAxis up) {
  std::vector<double> areas(mesh.triangles.size());
  double total = 0;
  const auto corner = [&](const Triangle& t, std::size_t k) {
    return upright(mesh.points[static_cast<std::size_t>(t[k])], up);
  };
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vector3d a = corner(t, 1) - corner(t, 0), b = corner(t, 2) - corner(t, 0);
    total += areas[i] =
        Vector3d(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()).norm();
  }
  std::vector<Vector3d> points;
  if (!(total > 0) || !std::isfinite(total)) return points;
  double before = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    before += areas[i];
    const Triangle& t = mesh.triangles[i];
    while (static_cast<double>(points.size()) + 0.5 < before / total * static_cast<double>(most_samples)) {
      double u = uniform(1, points.size()), v = uniform(2, points.size());
      if (u + v > 1) u = 1 - u, v = 1 - v;
      points.push_back((1 - u - v) * corner(t, 0) + u * corner(t, 1) + v * corner(t, 2));
    }
  }
  Vector3d middle = Vector3d::Zero(), low = points.front(), high = low;
  for (const Vector3d& p : points) {
    middle += p / static_cast<double>(points.size());
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  for (Vector3d& p : points) p = (p - middle) / (high - low).norm();
  return points;
}

/// How much of the surface is in each cell, blurred a little.
class Density {
 public:
  Density(const std::vector<Vector3d>& points, const Vector3d& mirror) : cells_(side * side * side) {
    for (const Vector3d& p : points) add(p - 2 * p.dot(mirror) * mirror, 1 / static_cast<double>(points.size()));
  }

  /// 1 where both are the same, 0 where they are apart.
  double overlap(const Density& other) const {
    double sum = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) sum += std::min(cells_[i], other.cells_[i]);
    return sum;
  }

 private:
  static constexpr int side = 32;

  void add(const Vector3d& p, double weight) {
    constexpr double cell = 0.04;
    std::array<int, 3> low{};
    std::array<double, 3> share{};
    for (int k = 0; k < 3; ++k) {
      const double x = std::clamp(p[k] / cell + side / 2.0, 0.0, side - 1.001);
      low[k] = static_cast<int>(x);
      share[k] = x - low[k];
    }
    for (int corner = 0; corner < 8; ++corner) {
      double w = weight;
      std::size_t index = 0;
      for (int k = 0; k < 3; ++k) {
        const int next = corner >> k & 1;
        w *= next ? share[k] : 1 - share[k];
        index = index * side + static_cast<std::size_t>(low[k] + next);
      }
      cells_[index] += w;
    }
  }

  std::vector<double> cells_;
};

/// Upright planes are known by the direction of their normal, in degrees; the most symmetric one, if there is one.
std::optional<int> mirror_of(const std::vector<Vector3d>& points) {
  const Density as_it_is(points, Vector3d::Zero());
  std::array<double, 180 / step> same{};
  for (std::size_t i = 0; i < same.size(); ++i) {
    const double angle = static_cast<double>(i) * step * std::numbers::pi / 180;
    same[i] = as_it_is.overlap(Density(points, {std::sin(angle), 0, std::cos(angle)}));
  }
  const auto best = static_cast<int>(std::ranges::max_element(same) - same.begin());
  constexpr int near = 30 / step;  // of one mirror
  double other = 0;
  for (int i = 0; i < static_cast<int>(same.size()); ++i) {
    const int apart = std::abs(i - best);
    if (std::min(apart, static_cast<int>(same.size()) - apart) > near)
      other = std::max(other, same[static_cast<std::size_t>(i)]);
  }
  constexpr double least = 0.5, lead = 0.15;
  const double found = same[static_cast<std::size_t>(best)];
  if (found < least || found < other + lead) return {};
  return best * step;
}

/// How far, along a direction, the surface between two heights (0 at the foot and 1 at the top) lies ahead of the
/// whole: in lengths of the shape along it.
struct Profile {
  Profile(const std::vector<Vector3d>& points, const Vector3d& ahead) {
    double low = 0, high = 0, foot = 0, top = 0;
    for (const Vector3d& p : points) {
      low = std::min(low, p.dot(ahead)), high = std::max(high, p.dot(ahead));
      foot = std::min(foot, p.y()), top = std::max(top, p.y());
    }
    length = high - low, height = top - foot;
    const auto mean = [&](double from, double to) {
      double sum = 0, count = 0;
      for (const Vector3d& p : points)
        if (const double h = (p.y() - foot) / height; h >= from && h <= to) sum += p.dot(ahead), ++count;
      return count > 0 ? sum / count / length : 0;
    };
    head = mean(0.75, 1), feet = mean(0, 0.1);
  }
  double length, height, head, feet;
};

}  // namespace

std::optional<double> front_of(const TriangleMesh& mesh, UpAxis up) {
  const std::vector<Vector3d> points = spread_points(mesh, up);
  if (points.empty()) return {};
  const std::optional<int> mirror = mirror_of(points);
  if (!mirror) return {};
  const double ahead = *mirror + 90.0, angle = ahead * std::numbers::pi / 180;
  const Profile profile(points, {std::sin(angle), 0, std::cos(angle)});
  constexpr double plain = 0.08, step_of_feet = 0.06, sheet = 0.45;
  double sign = 0;
  if (std::abs(profile.head) > plain && profile.head * profile.feet < 0)
    sign = profile.head;
  else if (profile.length < sheet * profile.height && std::abs(profile.feet) > step_of_feet)
    sign = profile.feet;
  if (sign == 0) return {};
  return sign > 0 ? ahead : ahead - 180;
}

}  // namespace pelage
