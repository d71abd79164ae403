#include "shape/grid.h"

#include <algorithm>
#include <cmath>

#include "pelage/error.h"

namespace pelage {

std::size_t Grid::nodes() const {
  return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
}

Point Grid::point(std::int32_t node) const {
  if (!points.empty()) return points[static_cast<std::size_t>(node)];
  const std::int32_t place[] = {node % count[0], node / count[0] % count[1], node / count[0] / count[1]};
  Point p = origin;
  for (std::size_t d = 0; d < 3; ++d) p[d] += spacing[d] * place[d];
  return p;
}

std::vector<std::string> axis_ends(const Grid& grid) {
  std::vector<std::string> names;
  for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dimension()); ++a)
    if (!grid.periodic[a])
      for (const char* end : {"min", "max"}) names.push_back(std::string{"xyz"[a]} + end);
  return names;
}

std::optional<AxisEnd> axis_end(const Grid& grid, const std::string& name) {
  if (std::ranges::count(axis_ends(grid), name) == 0) return {};
  return AxisEnd{static_cast<std::size_t>(name[0] - 'x'), name.ends_with("max")};
}

std::int32_t shown_cells(const Grid& grid, std::size_t axis) {
  const bool closes = grid.periodic[axis] && !grid.even() && grid.period[axis] == Point{};
  return closes ? grid.count[axis] : grid.count[axis] - 1;
}

TriangleMesh mesh_of(const Grid& grid) {
  TriangleMesh mesh;
  const auto nodes = static_cast<std::int32_t>(grid.nodes());
  mesh.points.reserve(grid.nodes());
  for (std::int32_t v = 0; v < nodes; ++v) mesh.points.push_back(grid.point(v));
  mesh.attributes = grid.attributes;
  mesh.metres_per_unit = grid.metres_per_unit;
  if (grid.dimension() != 2) return mesh;
  const auto [nx, ny, nz] = grid.count;
  const std::int32_t right = shown_cells(grid, 0), top = shown_cells(grid, 1);
  mesh.triangles.reserve(2 * static_cast<std::size_t>(right) * static_cast<std::size_t>(top));
  for (std::int32_t j = 0; j < top; ++j)
    for (std::int32_t i = 0; i < right; ++i) {
      const std::int32_t a = grid.node(i, j, 0), b = grid.node((i + 1) % nx, j, 0),
                         c = grid.node((i + 1) % nx, (j + 1) % ny, 0), d = grid.node(i, (j + 1) % ny, 0);
      // Diagonals alternate, so that no direction is preferred.
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  return mesh;
}

Attribute uv_of(const Grid& grid) {
  Attribute uv{"uv", 2, Domain::vertex, {}};
  uv.values.reserve(2 * grid.nodes());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) {
    uv.values.push_back((v % grid.count[0] + 0.5) / grid.count[0]);
    uv.values.push_back((v / grid.count[0] % grid.count[1] + 0.5) / grid.count[1]);
  }
  return uv;
}

Point period_of(const Grid& grid) {
  Point period{};
  for (std::size_t d = 0; d < 3; ++d)
    if (grid.even() && grid.periodic[d]) period[d] = grid.spacing[d] * grid.count[d];
  return period;
}

double mean_edge(const Grid& grid) {
  if (grid.even()) {
    double product = 1;
    for (int d = 0; d < grid.dimension(); ++d) product *= grid.spacing[static_cast<std::size_t>(d)];
    return std::pow(product, 1.0 / grid.dimension());
  }
  double sum = 0;
  std::size_t count = 0;
  std::int32_t stride = 1;
  for (std::size_t d = 0; d < 3; stride *= grid.count[d++])
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) {
      if (v / stride % grid.count[d] == grid.count[d] - 1) continue;
      const Point a = grid.point(v), b = grid.point(v + stride);
      sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      ++count;
    }
  return sum / static_cast<double>(count);
}

Box box_of_cells(const Grid& grid) {
  if (!grid.even()) return box_of(grid.points);
  Box box{grid.origin, grid.origin};
  for (std::size_t d = 0; d < 3; ++d) box.high[d] += grid.spacing[d] * grid.cells(static_cast<int>(d));
  return box;
}

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(Fault::input, "the grid " + what); }

bool finite(const Point& p) {
  return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

void require_counts(const Grid& grid) {
  constexpr double most = 2147483647.0;
  double nodes = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::int32_t n = grid.count[d];
    if (n < 1) refuse("needs at least one node along every axis");
    if (grid.periodic[d] && n < 3) refuse("needs three nodes along a periodic axis");
    nodes *= n;
  }
  if (grid.count[0] < 2) refuse("needs two nodes along its first axis");
  if (grid.count[1] < 2 && grid.count[2] > 1) refuse("has an extent along its third axis and none along its second");
  if (nodes > most) refuse("has more nodes than can be counted");
}

}  // namespace

void require_sound(const Grid& grid) {
  require_counts(grid);
  if (!grid.even() && grid.points.size() != grid.nodes())
    refuse("has " + std::to_string(grid.points.size()) + " points for " + std::to_string(grid.nodes()) + " nodes");
  if (!std::ranges::all_of(grid.points, finite) || !finite(grid.origin)) refuse("has a point that is not finite");
  for (std::size_t d = 0; d < 3; ++d)
    if (grid.even() && !(grid.spacing[d] > 0 && std::isfinite(grid.spacing[d])))
      refuse("has a spacing that is not greater than 0");
  for (const Attribute& a : grid.attributes)
    if (a.domain != Domain::vertex || a.components < 1 ||
        a.values.size() != grid.nodes() * static_cast<std::size_t>(a.components))
      refuse("has an attribute \"" + a.name + "\" of another number than its nodes");
}

}  // namespace pelage
