#pragma once
// Which side of a line or a plane a point lies on, without a doubt.

#include <array>

#include "pelage/point.h"

namespace pelage {

using PlanePoint = std::array<double, 2>;

/// The sign of the turn from a over b to c: 1 to the left, -1 to the right, 0 straight on. Exact for coordinates whose
/// products neither overflow nor underflow (Shewchuk 1997).
int turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// The sign of (b - a) x (c - a) . (d - a): 1 where d lies above the triangle a b c, whose corners are then seen
/// counter-clockwise from it. Exact likewise.
int side(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace pelage
