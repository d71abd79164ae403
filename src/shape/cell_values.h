#pragma once
// Values anywhere on cells: v'(P) = sum v(Q) w(|P - Q| / s) / sum w with w(d) = 2 d^3 - 3 d^2 + 1 and s twice the
// radius of repulsion (Turk 1991, section 5).

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "pelage/cells.h"
#include "shape/cell_neighbours.h"
#include "shape/closest_point.h"

namespace pelage {

class CellValues {
 public:
  /// `cells` must outlive it.
  explicit CellValues(const Cells& cells) : cells_(cells), neighbours_(cells.points, cells.normals, cells.radius) {}

  struct Weight {
    std::int32_t cell;
    double share;  ///< they sum to 1
    Point slope;   ///< of the share [1 / world unit], as the place moves
  };
  /// Of the cells around a place of a surface with this normal, on its own sheet; where there are none, of the nearest
  /// alone. Replaces `found`.
  void at(const Point& place, const Point& normal, std::vector<Weight>& found) const;
  std::int32_t nearest(const Point& place) const;

 private:
  const Cells& cells_;
  CellNeighbours neighbours_;
  mutable std::once_flag tree_made_;
  mutable std::unique_ptr<const DistanceTree> tree_;  ///< of the points
};

}  // namespace pelage
