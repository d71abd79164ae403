#include "gridgen/sheet.h"

#include "shape/vectors.h"

namespace pelage {

CellEdges::CellEdges(const std::array<Point, 4>& x)
    : south(difference(x[1], x[0])),
      east(difference(x[2], x[1])),
      north(difference(x[2], x[3])),
      west(difference(x[3], x[0])) {}

std::array<double, 2> mean_edges(const Sheet& sheet, const std::vector<Point>& nodes) {
  const auto [n, m] = sheet.count;
  const auto way = [&](std::size_t a, std::size_t b) { return length(difference(nodes[a], nodes[b])); };
  double along = 0, across = 0;
  for (std::int32_t i = 0; i < sheet.columns(); ++i)
    for (const std::int32_t j : {0, m - 1}) along += way(sheet.node(i, j), sheet.node((i + 1) % n, j)) / 2;
  along /= sheet.columns();
  if (sheet.ring) {
    for (std::int32_t i = 0; i < n; ++i) across += way(sheet.node(i, 0), sheet.node(i, m - 1)) / n;
  } else {
    for (std::int32_t j = 0; j + 1 < m; ++j)
      for (const std::int32_t i : {0, n - 1}) across += way(sheet.node(i, j), sheet.node(i, j + 1)) / 2;
  }
  return {along, across / (m - 1)};
}

std::size_t first_folded(const Sheet& sheet, const std::vector<Point>& nodes) {
  for (std::size_t c = 0; c < sheet.cells(); ++c) {
    const auto v = sheet.corners(c);
    const CellEdges edges({nodes[v[0]], nodes[v[1]], nodes[v[2]], nodes[v[3]]});
    for (const auto& [along, across] : edges.corners())
      if (!(plane_cross(along, across) > 0)) return c;
  }
  return sheet.cells();
}

}  // namespace pelage
