#pragma once
// What is asked of a grid, as functions of its nodes: the functionals of Castillo and Steinberg (Castillo,
// "Mathematical Aspects of Numerical Grid Generation", 1991) and, against folds, that of Winslow in the form of
// Brackbill and Saltzman
// ("Adaptive zoning for singular problems in two dimensions", 1982).
//
//   F_L = 1/2 sum_edges w |e|^2 / l^2         even lengths; l the mean length along the axis
//   F_S = 1/8 sum_corners (|e|^2 m/l + |f|^2 l/m) / J   smooth lines; m the mean length along the other axis, J = |e x
//   f| F_A = 1/2 sum_cells w^2 A^2 / a^2         even areas; a the mean area F_O = 1/2 sum_corners w^2 (e . f)^2 / a^2
//   right angles; the mean over the four corners of a cell
//
// each per cell, so that neither the unit nor the number of nodes matters; edges of the border count half. w is the
// attraction over its mean: F_L, F_A and F_O are those of a surface whose lengths are sqrt(w) longer, on which cells of
// like areas are small where w is large, and F_S lets lines diffuse the less the larger w is. As g11 g22 = g + g12^2,
// equal weights of area and orthogonality stand for the integral of g11 g22. On a surface the edges are those in space,
// and the nodes move in the plane of its parameters.

#include <optional>

#include "gridgen/border.h"
#include "gridgen/sheet.h"

namespace pelage {

class SheetFunctional {
 public:
  struct Parts {
    double length = 0, smoothness = 0, area = 0, orthogonality = 0;
  };

  /// Lengths and areas are counted in the means of these nodes. Without `map` the surface is the plane. `attract` and
  /// `map` must outlive it.
  SheetFunctional(const Sheet& sheet, const std::vector<Point>& nodes, const GridWeights& weights,
                  const NodeDensity* attract, const SurfaceMap* map);

  /// The weighted sum, infinite where a corner of a cell is folded in the plane; as F_S grows beyond all bounds before,
  /// its weight is at least 0.01 of all. Fills the gradient by the plane's coordinates.
  double operator()(const std::vector<Point>& nodes, std::vector<Point>& gradient) const;

  /// F_L, F_S, F_A and F_O.
  Parts parts(const std::vector<Point>& nodes) const;

 private:
  struct Attraction {
    std::vector<double> value;    ///< per cell, over the mean
    std::vector<Point> gradient;  ///< by the cell's middle
  };
  Attraction attraction(const std::vector<Point>& x) const;
  double metric(const std::vector<Point>& x, const GridWeights& weights, std::vector<Point>& gradient) const;

  Sheet sheet_;
  GridWeights weights_;
  const NodeDensity* attract_;
  const SurfaceMap* map_;
  double along2_ = 1, across2_ = 1, area_ = 1;  ///< mean squared lengths and mean area, in space
  double attraction_ = 1;                       ///< the mean
};

/// The sum of a function of all corners' edges in the plane over 4 times the number of cells; corner(along, across,
/// by_along, by_across) sets the derivatives by the edges. Adds to the gradient. Stops being evaluated at infinite
/// values.
using CornerFunction = double (*)(const Point& along, const Point& across, const std::array<double, 4>& constants,
                                  Point& by_along, Point& by_across);
double corner_mean(const Sheet& sheet, const std::vector<Point>& nodes, CornerFunction corner,
                   const std::array<double, 4>& constants, std::vector<Point>& gradient);

}  // namespace pelage
