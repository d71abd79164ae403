#pragma once
// Grids between borders by transfinite interpolation (Gordon and Hall, "Construction of curvilinear co-ordinate systems
// and applications to mesh generation", 1973), and from coarser grids.

#include "gridgen/border.h"
#include "gridgen/sheet.h"

namespace pelage {

/// The nodes of a sheet with that border: linear along both axes less what is counted twice. May fold. It is linear in
/// the border.
std::vector<Point> transfinite(const Sheet& sheet, const Border& border);

/// The nodes of a sheet with that border after those of a coarser one: cubic in between, moved so that the border fits.
std::vector<Point> refined(const Sheet& coarse, const std::vector<Point>& coarse_nodes, const Sheet& sheet,
                           const Border& border);

}  // namespace pelage
