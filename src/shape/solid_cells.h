#pragma once
// Volumes as files have them: cells of several shapes, with values at nodes and in cells.

#include <array>
#include <cstdint>
#include <vector>

#include "pelage/tet_mesh.h"
#include "shape/finding.h"

namespace pelage {

/// By the number of corners.
enum class CellShape : std::uint8_t { tetrahedron = 4, pyramid = 5, wedge = 6, hexahedron = 8 };

struct SolidCell {
  CellShape shape;
  /// Of pyramids the base, then the top; of wedges and hexahedra one end, then the other, each around in one sense.
  std::array<std::int32_t, 8> corner;
};

struct SolidCells {
  std::vector<Point> points;
  std::vector<SolidCell> cells;
  std::vector<Attribute> at_nodes;  ///< Domain::vertex
  std::vector<Attribute> in_cells;  ///< one tuple per cell, Domain::face
  std::optional<double> metres_per_unit = {};
};

/// The volume as tetrahedra, the other cells being cut so that neighbours fit together. Values of cells become such of
/// nodes: the mean of the cells around, by their volume, or of integers the value that most of it has. Findings: cells
/// that were turned inside out, warped, flat (left out) or there twice (left out), faces at which three cells meet,
/// nodes of no cell (left out), values of cells, values that are not finite. Corners must be numbers of points.
/// ShapeFault: no cell with a volume, a place that is not finite or beyond 1e75.
TetMesh tets_of(SolidCells cells, std::vector<Finding>& findings);

}  // namespace pelage
