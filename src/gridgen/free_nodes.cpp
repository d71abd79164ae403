#include "gridgen/free_nodes.h"

#include <cmath>

#include "gridgen/sheet_modes.h"

namespace pelage {

Minimum minimise_inner(const Sheet& sheet, std::vector<Point>& nodes, const SheetObjective& objective,
                       const MinimiseOptions& options) {
  const auto [along, across] = mean_edges(sheet, nodes);
  const SheetModes modes(sheet, along, across);
  std::vector<double> amplitudes(modes.size());
  const std::vector<Point> start = nodes;
  std::vector<Point> by_nodes;
  const Minimum minimum = minimise(
      [&](const std::vector<double>& at, std::vector<double>& gradient) {
        nodes = start;
        modes.displace(at, nodes);
        const double value = objective(nodes, by_nodes);
        if (std::isfinite(value)) modes.gradient(by_nodes, gradient);
        return value;
      },
      amplitudes, options);
  nodes = start;
  modes.displace(amplitudes, nodes);
  return minimum;
}

}  // namespace pelage
