#include "unwrap/stretch.h"

#include <Eigen/LU>
#include <algorithm>

#include "shape/vectors.h"

namespace pelage {

RestTriangle rest_triangle(const std::array<Point, 3>& p) {
  RestTriangle rest;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double side = length(difference(p[(k + 1) % 3], p[k]));
    if (side <= longest) continue;
    longest = side;
    rest.first = k;
  }
  const Point a = difference(p[(rest.first + 1) % 3], p[rest.first]);
  const Point b = difference(p[(rest.first + 2) % 3], p[rest.first]);
  const double height = std::max(length(cross(a, b)) / longest, least_height * longest);
  Eigen::Matrix2d sides;
  sides << longest, dot(a, b) / longest, 0, height;
  rest.inverse = sides.inverse();
  rest.area = longest * height / 2;
  return rest;
}

void StretchSum::add(double rest_area, const Eigen::Matrix2d& derivative) {
  const double det = derivative.determinant();
  area += rest_area;
  flat += rest_area * det;
  squares += rest_area * derivative.squaredNorm() / (2 * det * det);
}

StretchSum& StretchSum::operator+=(const StretchSum& other) {
  area += other.area;
  flat += other.flat;
  squares += other.squares;
  return *this;
}

StretchSum stretch_of(const LinkedFaces& faces, const Chart& chart) {
  StretchSum sum;
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    std::array<Point, 3> p;
    std::array<Eigen::Vector2d, 3> u;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = faces.points[faces.triangles[chart.source[t]][k]];
      u[k] = Eigen::Vector2d(chart.uv[chart.triangles[t][k]].data());
    }
    const RestTriangle rest = rest_triangle(p);
    sum.add(rest.area, rest.derivative(u));
  }
  return sum;
}

}  // namespace pelage
