#pragma once
// Boxes and hulls of flattened charts.

#include <limits>
#include <vector>

#include "unwrap/chart.h"

namespace pelage {

/// The smallest box with sides along the axes.
struct FlatBox {
  Flat low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Flat high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(const Flat& p);
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};
FlatBox flat_box(const std::vector<Flat>& places);

/// Scaled and turned by c + i s, then shifted so that the lowest coordinates are 0.
std::vector<Flat> turned(const std::vector<Flat>& places, double c, double s);

/// Counter-clockwise (Andrew 1979).
std::vector<Flat> convex_hull(std::vector<Flat> places);
/// Of a polygon, counter-clockwise.
double area_of(const std::vector<Flat>& polygon);

/// Turned into its smallest box, which has a side along one of the hull (Freeman, Shapira 1975); lying down.
std::vector<Flat> in_smallest_box(const std::vector<Flat>& places);

}  // namespace pelage
