#pragma once
// Surfaces over a plane of parameters, on which the nodes of a grid move.

#include <memory>
#include <span>

#include "gridgen/curve.h"

namespace pelage {

/// Points of a surface with their derivatives along the parameters.
struct SurfacePoints {
  std::vector<Point> x, xu, xv;
};

class SurfaceMap {
 public:
  virtual ~SurfaceMap() = default;
  /// At parameters (u, v, 0).
  virtual SurfacePoints at(std::span<const Point> parameters) const = 0;
};

/// x, y and z as functions of u and v.
std::unique_ptr<SurfaceMap> formula_surface(std::array<FormulaFunction, 3> coordinates);

/// Between four curves in space that meet in the corners (Coons, "Surfaces for computer-aided design of space forms",
/// 1967): over the unit square, u and v being the shares of their lengths. South, east, north and west as Sides of
/// gridgen/border.h.
std::unique_ptr<SurfaceMap> coons_surface(const std::array<Curve, 4>& sides);
/// The sides of the unit square, with knots where those curves have theirs.
std::array<Curve, 4> coons_parameters(const std::array<Curve, 4>& sides);

}  // namespace pelage
