#pragma once
// What is asked of a grid of three dimensions, per corner of its cells: with e, f, g the edges there over the mean
// lengths along their axes, and J the volume of their parallelepiped over the mean volume of cells,
//
//   length 1/2 (|e|^2 + |f|^2 + |g|^2), smoothness (|e|^2 + |f|^2 + |g|^2) / (3 J^(2/3)), area 1/2 J^2 (of the volume),
//   orthogonality 1/2 ((e . f)^2 + (f . g)^2 + (g . e)^2).

#include "gridgen/block.h"
#include "gridgen/region.h"

namespace pelage {

class BlockFunctional {
 public:
  /// The means are those of these nodes. `blunt` > 0 replaces J in smoothness by (J + sqrt(J^2 + blunt^2)) / 2, which
  /// is finite at folds (gridgen/untangle.h).
  BlockFunctional(const Block& block, const std::vector<Point>& nodes, const GridWeights& weights, double blunt = 0);

  /// The weighted mean over all corners of cells; infinite at folds, unless it is blunt. Fills the gradient by the
  /// nodes.
  double operator()(const std::vector<Point>& nodes, std::vector<Point>& gradient) const;

  /// The smallest J.
  double smallest(const std::vector<Point>& nodes) const;

 private:
  double corner(const BlockCorner& c, std::array<Point, 3>& by_edges) const;

  Block block_;
  GridWeights weights_;
  double blunt_;
  std::array<double, 3> length_{};
  double volume_ = 1;
};

}  // namespace pelage
