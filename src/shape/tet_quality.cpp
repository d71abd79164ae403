#include "shape/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::array<Point, 4> corners(const TetMesh& mesh, const Tetrahedron& t) {
  const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
  return {at(0), at(1), at(2), at(3)};
}

double volume6(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(cross(difference(b, a), difference(c, a)), difference(d, a));
}

}  // namespace

double signed_volume(const Point& a, const Point& b, const Point& c, const Point& d) { return volume6(a, b, c, d) / 6; }

std::array<double, 4> shares_in(const std::array<Point, 4>& corners, const Point& p) {
  const auto& [a, b, c, d] = corners;
  const double whole = volume6(a, b, c, d);
  return {volume6(p, b, c, d) / whole, volume6(a, p, c, d) / whole, volume6(a, b, p, d) / whole,
          volume6(a, b, c, p) / whole};
}

double volume_of(const TetMesh& mesh) {
  return ordered_sum(mesh.tets.size(), 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const auto p = corners(mesh, mesh.tets[t]);
      sum += signed_volume(p[0], p[1], p[2], p[3]);
    }
    return sum;
  });
}

std::pair<double, double> dihedral_angles(const std::array<Point, 4>& p) {
  // At the edge from a to b, between the faces to c and to d.
  constexpr std::array<std::array<std::size_t, 4>, 6> edges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  double least = std::numbers::pi, most = 0;
  for (const auto& [a, b, c, d] : edges) {
    const Point along = difference(p[b], p[a]);
    const Point m = cross(along, difference(p[c], p[a])), n = cross(along, difference(p[d], p[a]));
    const double angle = std::atan2(length(cross(m, n)), dot(m, n));
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  return {least * 180 / std::numbers::pi, most * 180 / std::numbers::pi};
}

namespace {

struct Extremes {
  double least = 180, most = 0;
  Extremes& operator+=(const Extremes& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    return *this;
  }
};

}  // namespace

std::pair<double, double> dihedral_angles(const TetMesh& mesh) {
  const Extremes all = ordered_sum(mesh.tets.size(), Extremes{}, [&](std::size_t begin, std::size_t end) {
    Extremes part;
    for (std::size_t t = begin; t < end; ++t) {
      const auto [least, most] = dihedral_angles(corners(mesh, mesh.tets[t]));
      part += {least, most};
    }
    return part;
  });
  return {all.least, all.most};
}

}  // namespace pelage
