#pragma once
// Polygons that do not fit together.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// Adds the flat square a, a + e, a + e + f, a + f as n x n squares of two triangles with vertices of their own.
inline void add_square(TriangleMesh& mesh, const Point& a, const Point& e, const Point& f, int n = 1) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto first = static_cast<std::int32_t>(mesh.points.size());
      for (const auto& [u, v] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        Point p = a;
        for (std::size_t k = 0; k < 3; ++k) p[k] += (i + u) * e[k] / n + (j + v) * f[k] / n;
        mesh.points.push_back(p);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
}

/// The unit cube of six squares that share no vertex.
inline TriangleMesh six_squares() {
  TriangleMesh mesh;
  add_square(mesh, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  add_square(mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  add_square(mesh, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  add_square(mesh, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  add_square(mesh, {0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  add_square(mesh, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  return mesh;
}

/// The square from 0 to 2 in x and 0 to 1 in y: the half x < 1 in 3 x 3 parts, the other in 4 x 4, so that vertices of
/// either lie in the middle of the other's edges.
inline TriangleMesh square_with_t_junctions() {
  TriangleMesh mesh;
  add_square(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3);
  add_square(mesh, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4);
  return mesh;
}

/// A wall of rows x rows bricks of two triangles each, every other row begun by half a brick: corners of a row lie in
/// the middle of the edges of the next. `side` of a brick.
inline TriangleMesh brick_wall(int rows, double side) {
  TriangleMesh mesh;
  for (int row = 0; row < rows; ++row) {
    const double shift = row % 2 == 0 ? 0 : side / 2;
    for (int k = row % 2 == 0 ? 0 : -1; k < rows; ++k) {
      const double begin = std::max(0.0, k * side + shift), end = std::min(rows * side, (k + 1) * side + shift);
      add_square(mesh, {begin, row * side, 0}, {end - begin, 0, 0}, {0, side, 0});
    }
  }
  return mesh;
}

/// A folding screen of square-cornered panels that share no vertex, each a unit wide and at a right angle to the next.
inline TriangleMesh folding_screen(int panels, double height) {
  TriangleMesh mesh;
  Point begin{};
  for (int k = 0; k < panels; ++k) {
    const Point along = k % 2 == 0 ? Point{1, 0, 0} : Point{0, 1, 0};
    add_square(mesh, begin, along, {0, 0, height});
    for (std::size_t d = 0; d < 3; ++d) begin[d] += along[d];
  }
  return mesh;
}

/// The parts of a soup, so many triangles each, moved along x until none is near another: part k by k * `by`.
inline TriangleMesh drawn_apart(TriangleMesh soup, std::size_t triangles_of_part, double by) {
  std::vector<char> moved(soup.points.size(), 0);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (const std::int32_t v : soup.triangles[t]) {
      const auto vertex = static_cast<std::size_t>(v);
      if (!moved[vertex]) soup.points[vertex][0] += by * static_cast<double>(t / triangles_of_part);
      moved[vertex] = 1;
    }
  return soup;
}

/// Two unit spheres in a row along x, parts of the same number of triangles.
inline TriangleMesh two_spheres(double distance, const TriangleMesh& sphere) {
  TriangleMesh both;
  for (const double x : {0.0, distance}) {
    const auto first = static_cast<std::int32_t>(both.points.size());
    for (const Point& p : sphere.points) both.points.push_back({p[0] + x, p[1], p[2]});
    for (const Triangle& t : sphere.triangles) both.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return both;
}

/// The closed surface that a curve of points (x, distance from the x axis) makes when it turns about this axis: from
/// axis to axis, with vertices about `edge` apart on every ring.
inline TriangleMesh turned_about_x(const std::vector<std::array<double, 2>>& curve, double edge) {
  constexpr double turn = 2 * std::numbers::pi;
  TriangleMesh mesh;
  std::vector<std::int32_t> first, count;  // of the vertices of each ring
  for (std::size_t ring = 0; ring < curve.size(); ++ring) {
    const auto [x, radius] = curve[ring];
    const bool pole = ring == 0 || ring + 1 == curve.size();
    first.push_back(static_cast<std::int32_t>(mesh.points.size()));
    count.push_back(pole ? 1 : std::max(3, static_cast<std::int32_t>(std::lround(turn * radius / edge))));
    for (std::int32_t k = 0; k < count[ring]; ++k) {
      const double angle = turn * k / count[ring];
      mesh.points.push_back({x, pole ? 0 : radius * std::cos(angle), pole ? 0 : radius * std::sin(angle)});
    }
  }
  for (std::size_t ring = 1; ring < curve.size(); ++ring) {
    const std::int32_t m = count[ring - 1], n = count[ring];
    const auto below = [&](std::int32_t k) { return first[ring - 1] + k % m; };
    const auto above = [&](std::int32_t k) { return first[ring] + k % n; };
    for (std::int32_t i = 0, j = 0; i < (m == 1 ? 0 : m) || j < (n == 1 ? 0 : n);) {
      const bool next_below = m > 1 && (n == 1 || j == n || (i < m && (i + 1) * n < (j + 1) * m));
      if (next_below)
        mesh.triangles.push_back({below(i), above(j), below(i + 1)}), ++i;
      else
        mesh.triangles.push_back({below(i), above(j), above(j + 1)}), ++j;
    }
  }
  return mesh;
}

/// What is seen of two_spheres(distance), as one closed surface whose edges run along the circle where they meet.
inline TriangleMesh united_spheres(double distance, double edge) {
  const double end = std::acos(-distance / 2);  // angle from the outer pole to the circle
  const int rings = static_cast<int>(std::ceil(end / (edge * std::sqrt(0.75))));
  std::vector<std::array<double, 2>> curve;
  for (int k = 0; k <= 2 * rings; ++k) {
    const double angle = end * (k <= rings ? k : 2 * rings - k) / rings, x = -std::cos(angle);
    curve.push_back({k <= rings ? x : distance - x, std::sin(angle)});
  }
  return turned_about_x(curve, edge);
}

inline std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

/// The vertices alone.
inline TriangleMesh cloud_of(TriangleMesh mesh) {
  mesh.triangles.clear();
  mesh.attributes.clear();
  return mesh;
}

}  // namespace pelage
