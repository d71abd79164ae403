#pragma once
// The cells of scattered points: Voronoi cells in their tangent planes, cut off where the surface ends.

#include <memory>
#include <vector>

#include "shape/cell_voronoi.h"

namespace pelage {

/// A straight piece of the border of a surface.
struct BorderPiece {
  Point middle, normal;
  Point outward;  ///< tangential, of unit length
  double half;    ///< of its length
};

/// Of all edges with one triangle, the pieces at which the cells do not go on beyond a crack of up to `cells.radius`.
std::vector<BorderPiece> border_pieces(const Cells& cells, const CellNeighbours& neighbours);

/// A symmetric matrix xx, xy, yy in the frame of a cell.
using PlaneMatrix = std::array<double, 3>;

/// Functions can be called from several threads.
class CellShapes {
 public:
  /// `stretch`: to how many times their width cells may be stretched by `contracted`; `cells` must outlive it.
  explicit CellShapes(const Cells& cells, double stretch = 1);

  struct Scratch {
    std::vector<CellNeighbour> found;
    std::vector<PlaneNeighbour> plane;
  };
  /// In the plane of TangentFrame(normal), with the point at the origin.
  PlaneCell shape(std::size_t cell, Scratch& scratch) const { return made(cell, scratch, nullptr); }
  /// The cell that it has among its neighbours x after these have been moved to C x.
  PlaneCell contracted(std::size_t cell, const PlaneMatrix& c, Scratch& scratch) const {
    return made(cell, scratch, &c);
  }
  const CellNeighbours& neighbours() const { return neighbours_; }
  const Cells& cells() const { return cells_; }

 private:
  PlaneCell made(std::size_t cell, Scratch& scratch, const PlaneMatrix* contraction) const;
  void cut_at_border(std::size_t cell, const TangentFrame& frame, const PlaneMatrix* contraction,
                     PlaneCell& shape) const;

  const Cells& cells_;
  double within_;  ///< neighbours are sought [world units]
  double reach_;   ///< of cells without neighbours
  CellNeighbours neighbours_;
  std::vector<BorderPiece> border_;
  std::unique_ptr<const PointIndex> border_index_;
};

}  // namespace pelage
