#pragma once
// How far a map into the plane is from an isometry.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "pelage/point.h"
#include "unwrap/chart.h"

namespace pelage {

/// A triangle in its own plane, its longest side along the first axis; what is thinner than `least_height` of that side
/// is as high as that, so that it has an area to be laid out.
struct RestTriangle {
  Eigen::Matrix2d inverse;  ///< of its two sides from corner `first`, as columns
  int first = 0;
  double area = 0;

  /// Derivative of the map that takes the corners to these places, in which u follows the corners of the triangle.
  Eigen::Matrix2d derivative(const std::array<Eigen::Vector2d, 3>& u) const {
    Eigen::Matrix2d sides;
    sides.col(0) = u[(first + 1) % 3] - u[first];
    sides.col(1) = u[(first + 2) % 3] - u[first];
    return sides * inverse;
  }
};
inline constexpr double least_height = 1e-4;
RestTriangle rest_triangle(const std::array<Point, 3>& p);

/// Sums of a map, from which its L2 stretch follows (Sander, Snyder, Gortler, Hoppe 2001): the root mean square over
/// the surface of the lengths by which the inverse of the map stretches unit vectors, at the scale at which the map
/// keeps the area as a whole. 1 for an isometry, more for all else.
struct StretchSum {
  double area = 0;     ///< in space
  double flat = 0;     ///< in the plane
  double squares = 0;  ///< area times (1 / s1^2 + 1 / s2^2) / 2 with the singular values of the derivative

  void add(double rest_area, const Eigen::Matrix2d& derivative);
  StretchSum& operator+=(const StretchSum& other);
  double stretch() const { return std::sqrt(squares / area * flat / area); }
};
StretchSum stretch_of(const LinkedFaces& faces, const Chart& chart);

}  // namespace pelage
