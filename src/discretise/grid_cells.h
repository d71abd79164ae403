#pragma once
// Multilinear elements on the cells between the nodes of grids: lines, quadrilaterals and hexahedra, in the plane or in
// space. They know nothing of rows and columns, so that several grids that share nodes along their edges are cells,
// too.
//
// With the tangents t_a of the axes of a cell, their dual basis t^a (in a surface: in its tangent plane) and the volume
// element J = sqrt(g), stiffness matrices hold J t^a . T t^b = (1/J) C_ai T_ij C_bj with the cofactors C = J t^a of
// transformed equations (1/J) d_a (J t^a . T t^b d_b u) on fitted grids.
//
// Each axis has the quadrature points +-xi of [-1, 1]. With xi^2 = 2/3, between Gauss' 1/3 and the corners' 1, the
// errors of mass and stiffness cancel: waves on even grids have their k^2 to the fourth order of the spacing
// (Ainsworth, Wajid 2010), as long as the principal axes of diffusion are those of the grid; across them it is the
// second. Linear functions have no residual in cells of any shape as long as the rule integrates the cofactors exactly:
// in a plane they are linear along each axis, in a volume quadratic, so that distorted cells there need Gauss' points.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "pelage/atlas.h"
#include "shape/topology.h"

namespace pelage {

struct GridCells {
  int dimension = 2;
  Index nodes = 0;
  std::vector<std::int64_t> first;  ///< per cell + 1: where its corners begin, 2^dimension of them
  std::vector<Index> corner;        ///< nodes; that with the number c is behind the first along the axes a of bits in c
  /// Per corner in bit a whether its place is behind the end of the periodic axis a, by `period[a]` from its node;
  /// empty: none is.
  std::vector<std::uint8_t> behind;
  std::array<Point, 3> period{};
  bool one_sided = false;  ///< normals of neighbours may be opposite: there is no outside

  std::size_t count() const { return first.size() - 1; }
  int corners() const { return 1 << dimension; }
};

/// The cells of a grid, along its first axis first.
GridCells grid_cells(const Grid& grid);

/// The cells of all patches, seen from outside their first axis turning counter-clockwise to the second.
GridCells grid_cells(const Atlas& atlas);

/// Places of the corners of a cell, less that of the first.
using CellCorners = std::array<Eigen::Vector3d, 8>;
CellCorners cell_corners(const GridCells& cells, std::size_t cell, const std::vector<Point>& points);
/// The same of a cell along x, y and z.
CellCorners even_cell(const Point& spacing);

/// The functions of a cell's corners at its quadrature points; bit a of a point's number is its side along axis a.
struct CellRule {
  CellRule(int dimension, double xi2);

  int dimension, points;
  double xi2;
  std::array<std::array<double, 8>, 8> value{};                 ///< [point][corner]
  std::array<std::array<std::array<double, 3>, 8>, 8> slope{};  ///< [point][corner][axis], the cell being [0, 1]^d
};

/// See above.
double quadrature_xi2(const Grid& grid);

/// A cell at one of its quadrature points.
struct CellPoint {
  double weight = 0;                                 ///< of the point times the volume element
  std::array<Eigen::Vector3d, 3> dual;               ///< t^a; 0 where the cell degenerates
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of a sheet, of length 1
  std::array<Eigen::Vector3d, 8> gradient;           ///< of the functions of the corners
};
using CellPoints = std::array<CellPoint, 8>;
void fill_cell_points(const CellRule& rule, const CellCorners& corners, CellPoints& points);

}  // namespace pelage
