#pragma once
// Curves in the plane or in space, over a parameter from 0 to 1: the sides of regions.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "gridgen/formula_function.h"
#include "pelage/point.h"

namespace pelage {

struct Curve {
  std::function<std::vector<Point>(std::span<const double>)> at;  ///< the points at parameters from 0 to 1
  std::vector<double> knots;  ///< from 0 to 1, ascending; only there may the curve have a corner
  Location where = {};        ///< in the region's file
};

/// Straight from point to point; at least two points.
Curve polyline(std::vector<Point> points, const Location& where);
/// x, y and z as functions of t.
Curve formula_curve(std::array<FormulaFunction, 3> coordinates, const Location& where);
/// The same run from its end to its start.
Curve reversed(const Curve& curve);
/// From one parameter to another one. Of a closed curve, where `to` is not greater, past its start.
Curve part(const Curve& curve, double from, double to);

/// A curve as many short straight pieces; every knot is a sample.
struct CurveSamples {
  std::vector<double> t;
  std::vector<Point> points;
  std::vector<double> length;      ///< along the curve from its start, weighted
  std::vector<std::size_t> knots;  ///< numbers of the samples at knots
  double total() const { return length.back(); }
  /// The parameter at a length, by the straight pieces.
  double parameter(double length) const;
};

/// `least`: pieces at the very least.
CurveSamples sample(const Curve& curve, std::size_t least = 1000);

}  // namespace pelage
