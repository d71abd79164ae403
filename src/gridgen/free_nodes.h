#pragma once
// The inner nodes of a sheet as unknowns of a minimisation.

#include <functional>

#include "gridgen/minimise.h"
#include "gridgen/sheet.h"

namespace pelage {

/// A function of all nodes of a sheet; sets the gradient, which has their size.
using SheetObjective = std::function<double(const std::vector<Point>& nodes, std::vector<Point>& gradient)>;

/// Moves the inner nodes in the plane to a minimum; the border stays. The function must be finite at the start.
Minimum minimise_inner(const Sheet& sheet, std::vector<Point>& nodes, const SheetObjective& objective,
                       const MinimiseOptions& options = {});

}  // namespace pelage
