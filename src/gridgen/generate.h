#pragma once
// Grids for regions: transfinite interpolation, unfolded where it folds, then moved to the minimum of the functional on
// ever finer grids.

#include <optional>

#include "gridgen/quality.h"
#include "gridgen/region.h"
#include "pelage/finding.h"
#include "pelage/grid.h"

namespace pelage {

struct GenerateOptions {
  std::optional<std::array<std::int32_t, 2>> nodes = {};  ///< instead of the region's; of a volume along and across
  int most_iterations = 2000;                             ///< on each of the finer and finer grids
};

struct GeneratedGrid {
  Grid grid;
  GridQuality quality;
  double functional = 0;    ///< at the end, the guard included (gridgen/functional.h)
  double folded_start = 0;  ///< share of cells that transfinite interpolation alone would have folded
  int iterations = 0;       ///< on all grids, unfolding included
  bool converged = false;
  std::vector<Finding> findings;
};

/// Error(usage), located, for borders that do not fit (gridgen/border.h); Error(numerics), with the place, for a grid
/// that cannot be unfolded.
GeneratedGrid generate(const Region& region, const GenerateOptions& options = {});

/// The nodes on the surface that is spanned between four sides which meet, by the weights of the region.
std::vector<Point> spanned_nodes(const Region& region, const std::array<Curve, 4>& sides,
                                 const std::array<std::int32_t, 2>& count);

}  // namespace pelage
