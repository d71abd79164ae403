#pragma once
// Turk's cells: points spread evenly over any polygons, or over a cloud of points (pelage/cells.h).

#include <cstddef>
#include <memory>

#include "base/box.h"
#include "pelage/cells.h"

namespace pelage {

class CellGround;

inline constexpr std::size_t fewest_cells = 16;
inline constexpr std::size_t most_cells = 4'000'000;

/// Makes cells on a shape. Polygons need not fit together; a mesh without triangles is a cloud of points: its normals
/// are those of the attribute "normal", or estimated; points that are far from all others, and copies, do not count.
class CellMaker {
 public:
  /// Error(Fault::input) where the shape has no area, or the cloud too few points.
  explicit CellMaker(std::shared_ptr<const TriangleMesh> on);
  ~CellMaker();

  /// n cells. Error(Fault::usage) for an n below fewest_cells or above most_cells.
  Cells make(std::size_t n) const;
  /// How many cells have neighbours `edge` apart in the mean, as the vertices of even triangles [world units].
  /// Error(Fault::usage) for more than most_cells, and for a cloud whose points are further apart than waves of such
  /// edges would be.
  std::size_t for_edge(double edge) const;
  /// Of all that counts.
  Box box() const;
  /// Points of a cloud that do not count since they are far from all others.
  std::size_t outliers() const;
  /// Of the area of polygons that lies inside other parts, where there are no cells.
  double covered_share() const;

 private:
  std::shared_ptr<const TriangleMesh> on_;
  std::unique_ptr<const CellGround> ground_;
};

/// The same at once.
Cells make_cells(std::shared_ptr<const TriangleMesh> on, std::size_t n);
std::size_t cells_for_edge(const TriangleMesh& on, double edge);

/// The points of a cloud that count (cloud_points.h) as cells themselves; their faces are their numbers. They reach
/// half as far again as even ones, since points of a cloud are less even. Error(Fault::input) as for CellMaker.
Cells cells_at_points(std::shared_ptr<const TriangleMesh> cloud);

/// The cells as vertices without triangles, with the attributes that the shape has at their places, and "normal".
TriangleMesh mesh_of(const Cells& cells);

}  // namespace pelage
