#include "discretise/grid_cells.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/parallel.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::array<std::int32_t, 3> cell_counts(const Grid& grid) {
  std::array<std::int32_t, 3> n{1, 1, 1};
  for (int a = 0; a < grid.dimension(); ++a) n[at(a)] = grid.cells(a);
  return n;
}

/// The corners of cell (i, j, k).
void fill_corners(const Grid& grid, const std::array<std::int32_t, 3>& cell, Index* corner, std::uint8_t* behind) {
  for (int c = 0; c < 1 << grid.dimension(); ++c) {
    std::array<std::int32_t, 3> place = cell;
    for (std::size_t a = 0; a < 3; ++a) {
      place[a] += c >> a & 1;
      if (place[a] < grid.count[a]) continue;
      place[a] = 0;
      behind[c] |= static_cast<std::uint8_t>(1 << a);
    }
    corner[c] = grid.node(place[0], place[1], place[2]);
  }
}

}  // namespace

GridCells grid_cells(const Grid& grid) {
  GridCells cells;
  cells.dimension = grid.dimension();
  cells.nodes = static_cast<Index>(grid.nodes());
  for (std::size_t a = 0; a < 3; ++a) {
    cells.period[a] = grid.period[a];
    if (grid.even()) cells.period[a][a] = grid.spacing[a] * grid.count[a];
  }
  const auto n = cell_counts(grid);
  const std::size_t count = at(n[0]) * at(n[1]) * at(n[2]), corners = at(cells.corners());
  cells.first.resize(count + 1);
  cells.corner.resize(count * corners);
  cells.behind.resize(count * corners);
  for (std::size_t e = 0; e <= count; ++e) cells.first[e] = static_cast<std::int64_t>(e * corners);
  parallel_for(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto row = static_cast<std::int32_t>(e / at(n[0]));
      fill_corners(grid, {static_cast<std::int32_t>(e % at(n[0])), row % n[1], row / n[1]},
                   cells.corner.data() + e * corners, cells.behind.data() + e * corners);
    }
  });
  return cells;
}

GridCells grid_cells(const Atlas& atlas) {
  GridCells cells;
  cells.nodes = atlas.nodes;
  cells.one_sided = atlas.one_sided;
  cells.first = {0};
  for (const Atlas::Patch& patch : atlas.patches) {
    const GridCells own = grid_cells(patch.grid);
    for (std::size_t e = 0; e < own.count(); ++e) {
      for (const std::size_t c :
           patch.turned ? std::array<std::size_t, 4>{0, 2, 1, 3} : std::array<std::size_t, 4>{0, 1, 2, 3})
        cells.corner.push_back(patch.node[at(own.corner[at(own.first[e]) + c])]);
      cells.first.push_back(static_cast<std::int64_t>(cells.corner.size()));
    }
  }
  return cells;
}

CellCorners cell_corners(const GridCells& cells, std::size_t cell, const std::vector<Point>& points) {
  CellCorners x;
  const std::size_t first = at(cells.first[cell]);
  const auto place = [&](std::size_t k) {
    return Eigen::Map<const Eigen::Vector3d>(points[at(cells.corner[k])].data());
  };
  for (std::size_t c = 0; c < at(cells.corners()); ++c) {
    x[c] = place(first + c) - place(first);
    if (cells.behind.empty()) continue;
    for (std::size_t a = 0; a < 3; ++a)
      if (cells.behind[first + c] >> a & 1) x[c] += Eigen::Map<const Eigen::Vector3d>(cells.period[a].data());
  }
  return x;
}

CellCorners even_cell(const Point& spacing) {
  CellCorners x;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t a = 0; a < 3; ++a) x[c][static_cast<int>(a)] = (c >> a & 1) != 0 ? spacing[a] : 0.0;
  return x;
}

CellRule::CellRule(int d, double square) : dimension(d), points(1 << d), xi2(square) {
  const double xi = std::sqrt(xi2);
  for (std::size_t q = 0; q < at(points); ++q)
    for (std::size_t c = 0; c < at(points); ++c) {
      value[q][c] = 1;
      slope[q][c] = {1, 1, 1};
      for (std::size_t a = 0; a < at(d); ++a) {
        const double factor = (((c ^ q) >> a & 1) != 0 ? 1 - xi : 1 + xi) / 2, sign = (c >> a & 1) != 0 ? 1 : -1;
        value[q][c] *= factor;
        for (std::size_t b = 0; b < at(d); ++b) slope[q][c][b] *= a == b ? sign : factor;
      }
    }
}

double quadrature_xi2(const Grid& grid) { return grid.dimension() == 3 && !grid.even() ? 1.0 / 3 : 2.0 / 3; }

namespace {

/// Of tangents t_0 up to t_(dimension - 1), with the volume element.
double fill_dual(int dimension, std::array<Eigen::Vector3d, 3> t, CellPoint& p) {
  for (Eigen::Vector3d& dual : p.dual) dual.setZero();
  if (dimension == 0) return 1;
  if (dimension == 1) {
    const double square = t[0].squaredNorm();
    if (square > 0) p.dual[0] = t[0] / square;
    return std::sqrt(square);
  }
  if (dimension == 2) t[2] = t[0].cross(t[1]);  // then the determinant is the square of its length
  const double determinant = t[0].dot(t[1].cross(t[2]));
  const double volume = dimension == 2 ? t[2].norm() : std::abs(determinant);
  if (!(volume > 0)) return 0;
  for (std::size_t a = 0; a < at(dimension); ++a) p.dual[a] = t[(a + 1) % 3].cross(t[(a + 2) % 3]) / determinant;
  if (dimension == 2) p.normal = t[2] / volume;
  return volume;
}

}  // namespace

void fill_cell_points(const CellRule& rule, const CellCorners& x, CellPoints& points) {
  for (std::size_t q = 0; q < at(rule.points); ++q) {
    CellPoint& p = points[q];
    std::array<Eigen::Vector3d, 3> tangent = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                              Eigen::Vector3d::Zero()};
    for (std::size_t a = 0; a < at(rule.dimension); ++a)
      for (std::size_t c = 0; c < at(rule.points); ++c) tangent[a] += rule.slope[q][c][a] * x[c];
    p.weight = fill_dual(rule.dimension, tangent, p) / rule.points;
    for (std::size_t c = 0; c < at(rule.points); ++c) {
      p.gradient[c].setZero();
      for (std::size_t a = 0; a < at(rule.dimension); ++a) p.gradient[c] += rule.slope[q][c][a] * p.dual[a];
    }
  }
}

}  // namespace pelage
