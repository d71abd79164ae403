#pragma once
// Closed curves as borders of regions: whether they cross themselves, which way they run, and where their corners are.

#include <optional>

#include "gridgen/region.h"

namespace pelage {

/// Twice the area of a closed polygon in the plane, negative where it runs clockwise.
double doubled_area(const std::vector<Point>& polygon);

/// Where two edges of a closed polygon cut each other: their numbers, that of the later one second, and the place.
struct Crossing {
  std::size_t first = 0, second = 0;
  Point place{};
};
std::optional<Crossing> first_crossing(const std::vector<Point>& polygon);

/// Whether a point of the plane lies inside a closed polygon.
bool contains(const std::vector<Point>& polygon, const Point& p);

/// The parameters of the four corners of an anticlockwise outline that give the best quadrilateral: places where it
/// turns to the left, as much as a right angle where there are such, with opposite sides of like lengths.
/// Anticlockwise, from the one that lies nearest to the lower left corner of the outline's box.
std::array<double, 4> find_corners(const Curve& outline);

}  // namespace pelage
