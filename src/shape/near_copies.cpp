#include "shape/near_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/checked.h"
#include "shape/edges.h"

namespace pelage {

namespace {

struct Cell {
  std::array<std::int64_t, 3> place;
  std::int32_t vertex;
  auto operator<=>(const Cell&) const = default;
};

double diagonal(const std::vector<Point>& points) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [k](const Point& a, const Point& b) { return a[k] < b[k]; });
    sum += ((*high)[k] - (*low)[k]) * ((*high)[k] - (*low)[k]);
  }
  return std::sqrt(sum);
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

void report_near_copies(const NumberedMesh& work, std::vector<Finding>& findings) {
  const TriangleMesh& mesh = work.mesh;
  std::vector<char> open(mesh.points.size(), 0);
  const EdgeTable edges(mesh.triangles, mesh.points.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1) open[tail(mesh.triangles, edges[e][0])] = open[tip(mesh.triangles, edges[e][0])] = 1;

  const double near = 1e-6 * diagonal(mesh.points);  // float coordinates are rounded to a tenth of that
  const double cell = 16 * near;                     // few neighbours are parted by the wall of a cell
  std::vector<Cell> cells;
  for (std::size_t v = 0; v < open.size(); ++v) {
    if (!open[v]) continue;
    Cell c{{}, static_cast<std::int32_t>(v)};
    for (int k = 0; k < 3; ++k)
      c.place[k] = saturated<std::int64_t>(std::floor((mesh.points[v][k] - mesh.points[0][k]) / cell));
    cells.push_back(c);
  }
  std::sort(cells.begin(), cells.end());
  Finding finding{"near-copies", "", 0, 0, false};
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const std::int32_t a = cells[i - 1].vertex, b = cells[i].vertex;
    if (cells[i].place != cells[i - 1].place) continue;
    const double d = distance(mesh.points[a], mesh.points[b]);
    if (d == 0 || d > near) continue;  // 0: sheets that touch there, reported already
    const auto number = static_cast<std::size_t>(work.vertex_number[b]);
    if (finding.count++ == 0 || number < finding.element) finding.element = number;
  }
  if (finding.count == 0) return;
  finding.text = counted(finding.count, "vertex") + " on open edges almost in the place of others (first: vertex " +
                 std::to_string(finding.element) +
                 "); the surface is cut there: merge them by distance in a modelling program if it should not be";
  findings.push_back(finding);
}

}  // namespace pelage
