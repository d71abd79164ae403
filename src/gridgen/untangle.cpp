#include "gridgen/untangle.h"

#include <algorithm>
#include <cmath>

#include "gridgen/free_nodes.h"
#include "gridgen/functional.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// Weight of even areas beside even shapes.
constexpr double area_share = 0.05;

/// constants: mean lengths along both axes, and the distance from folds below which the penalty is blunt.
double penalty(const Point& along, const Point& across, const std::array<double, 4>& constants, Point& by_along,
               Point& by_across) {
  const auto [l, m, blunt, unused] = constants;
  const double j = plane_cross(along, across) / (l * m), root = std::hypot(j, blunt);
  const double chi = (j + root) / 2, slope = (1 + j / root) / 2;
  const double shape =
      (along[0] * along[0] + along[1] * along[1]) / (l * l) + (across[0] * across[0] + across[1] * across[1]) / (m * m);
  const double top = shape + area_share * (j * j + 1);
  const double by_j = (area_share * 2 * j - top * slope / chi) / chi / (l * m);
  by_along = {2 * along[0] / (l * l * chi) + by_j * across[1], 2 * along[1] / (l * l * chi) - by_j * across[0], 0};
  by_across = {2 * across[0] / (m * m * chi) - by_j * along[1], 2 * across[1] / (m * m * chi) + by_j * along[0], 0};
  return top / chi;
}

/// The smallest J in the corners of cells, or 0.
double worst_corner(const Sheet& sheet, const std::vector<Point>& nodes) {
  double worst = 0;
  for (std::size_t c = 0; c < sheet.cells(); ++c) {
    const auto v = sheet.corners(c);
    const CellEdges e({nodes[v[0]], nodes[v[1]], nodes[v[2]], nodes[v[3]]});
    for (const auto& [along, across] : e.corners()) worst = std::min(worst, plane_cross(along, across));
  }
  return worst;
}

}  // namespace

Untangled untangle(const Sheet& sheet, std::vector<Point>& nodes) {
  constexpr int most_rounds = 60;
  Untangled result{first_folded(sheet, nodes) == sheet.cells(), 0};
  const auto [along, across] = mean_edges(sheet, nodes);
  for (int round = 0; round < most_rounds && !result.unfolded; ++round) {
    const double worst = worst_corner(sheet, nodes) / (along * across);
    const std::array<double, 4> constants = {along, across, std::sqrt(1e-12 + 0.04 * worst * worst), 0};
    const auto objective = [&](const std::vector<Point>& x, std::vector<Point>& gradient) {
      gradient.assign(x.size(), Point{});
      return corner_mean(sheet, x, penalty, constants, gradient);
    };
    result.iterations += minimise_inner(sheet, nodes, objective, {200, 1e-4, 10}).iterations;
    result.unfolded = first_folded(sheet, nodes) == sheet.cells();
  }
  return result;
}

}  // namespace pelage
