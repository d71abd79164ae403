#include "shape/turned.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pelage {

namespace {

using Corner = std::array<double, 2>;
using Profile = std::vector<Corner>;

Corner between(const Corner& a, const Corner& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

double distance(const Corner& a, const Corner& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// Each corner is cut off twice (Chaikin 1974); the ends stay.
Profile rounded(Profile profile) {
  for (const double cut : {0.3, 0.25, 0.25, 0.25}) {
    Profile next{profile.front()};
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const bool first = i == 0, last = i + 2 == profile.size();
      if (!first) next.push_back(between(profile[i], profile[i + 1], cut));
      if (!last) next.push_back(between(profile[i], profile[i + 1], 1 - cut));
    }
    next.push_back(profile.back());
    profile = std::move(next);
  }
  return profile;
}

double length_of(const Profile& profile) {
  double sum = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) sum += distance(profile[i - 1], profile[i]);
  return sum;
}

double area_of(const Profile& profile) {
  double sum = 0;
  for (std::size_t i = 1; i < profile.size(); ++i)
    sum += std::numbers::pi * (profile[i - 1][0] + profile[i][0]) * distance(profile[i - 1], profile[i]);
  return sum;
}

/// The same curve with so many equal steps.
Profile evenly(const Profile& profile, std::size_t steps) {
  const double step = length_of(profile) / static_cast<double>(steps);
  Profile even{profile.front()};
  double before = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double length = distance(profile[i - 1], profile[i]);
    while (even.size() < steps && static_cast<double>(even.size()) * step <= before + length)
      even.push_back(between(profile[i - 1], profile[i], (static_cast<double>(even.size()) * step - before) / length));
    before += length;
  }
  even.push_back(profile.back());
  return even;
}

/// Circles of vertices, one above the other, and the triangles between them.
class Rings {
 public:
  void add(const Corner& place, std::int32_t count, double turn) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (std::int32_t k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * (k + turn) / count;
      mesh.points.push_back({place[0] * std::sin(angle), place[1], place[0] * std::cos(angle)});
    }
    if (first > 0) join(first_, count_, turn_, first, count, turn);
    first_ = first, count_ = count, turn_ = turn;
  }

  TriangleMesh mesh;

 private:
  /// Around both rings; the next triangle goes to the vertex that is nearer.
  void join(std::int32_t a, std::int32_t n, double turn_a, std::int32_t b, std::int32_t m, double turn_b) {
    std::int32_t i = 0, j = 0;
    const auto next = [](std::int32_t k, std::int32_t count, double turn) { return (k + 1 + turn) / count; };
    while (i < n || j < m) {
      const std::int32_t at_a = a + i % n, at_b = b + j % m;
      const bool lower = j == m || (i < n && next(i, n, turn_a) < next(j, m, turn_b));
      if (lower && n > 1) mesh.triangles.push_back({at_a, a + (i + 1) % n, at_b});
      if (!lower && m > 1) mesh.triangles.push_back({at_a, b + (j + 1) % m, at_b});
      ++(lower ? i : j);
    }
  }

  std::int32_t first_ = 0, count_ = 0;
  double turn_ = 0;
};

double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

}  // namespace

TriangleMesh turned_shape(const std::vector<std::array<double, 2>>& profile, int vertices) {
  const Profile smooth = rounded(profile);
  // Equilateral triangles of edge h have an area of 0.433 h^2, and there are two for each vertex.
  const double edge = std::sqrt(area_of(smooth) / (0.866 * vertices)), rise = 0.866 * edge;
  const Profile even = evenly(smooth, std::max<std::size_t>(3, std::lround(length_of(smooth) / rise)));
  Rings rings;
  for (std::size_t i = 0; i < even.size(); ++i) {
    const bool end = i == 0 || i + 1 == even.size();
    const auto around = static_cast<std::int32_t>(std::lround(2 * std::numbers::pi * even[i][0] / edge));
    rings.add(even[i], end ? 1 : std::max(5, around), i % 2 == 0 ? 0 : 0.5);
  }
  TriangleMesh mesh = std::move(rings.mesh);
  if (volume_of(mesh) < 0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace pelage
