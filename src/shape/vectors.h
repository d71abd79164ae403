#pragma once
// Points as vectors.

#include <cmath>

#include "pelage/point.h"

namespace pelage {

inline Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// A vector of length 1 in the direction of a; 0 for 0.
inline Point unit(const Point& a) {
  const double l = length(a);
  return l > 0 ? Point{a[0] / l, a[1] / l, a[2] / l} : Point{};
}

}  // namespace pelage
