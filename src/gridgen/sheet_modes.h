#pragma once
// Displacements of the inner nodes of a sheet as sums of sines (of a ring: of sines and cosines around it), each scaled
// by the root of its eigenvalue under the discrete Laplacian. In these unknowns functions of the lengths of edges are
// about equally curved in all directions, on fine grids as on coarse ones, so that descents take few steps.

#include "gridgen/sheet.h"

namespace pelage {

class SheetModes {
 public:
  /// Mean lengths of the cells along both axes.
  SheetModes(const Sheet& sheet, double along, double across);

  /// Number of unknowns: two per inner node.
  std::size_t size() const { return 2 * inner_; }
  /// Adds the displacements to x and y of the inner nodes.
  void displace(const std::vector<double>& amplitudes, std::vector<Point>& nodes) const;
  /// The gradient by the amplitudes from that by the nodes.
  void gradient(const std::vector<Point>& by_nodes, std::vector<double>& by_amplitudes) const;

 private:
  /// Eigenvectors as rows of a symmetric or orthogonal matrix, and eigenvalues of -d^2 along an axis.
  struct Axis {
    std::int32_t count = 0;
    std::vector<double> rows;     ///< [mode * count + node]
    std::vector<double> columns;  ///< its transpose
    std::vector<double> values;
  };
  static Axis sines(std::int32_t count);
  static Axis circle(std::int32_t count);
  std::vector<double> transformed(const std::vector<double>& x, const std::vector<double>& along,
                                  const std::vector<double>& across) const;
  /// The number of the inner node (i, j) in the sheet.
  std::size_t node(std::size_t i, std::size_t j) const;

  Sheet sheet_;
  Axis along_, across_;
  std::size_t inner_ = 0;
  std::vector<double> scale_;  ///< 1 / root of the eigenvalue
};

}  // namespace pelage
