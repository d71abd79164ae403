#pragma once
// Grids as meshes.

#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "pelage/grid.h"

namespace pelage {

/// The nodes as vertices with their attributes; the cells of a sheet as two triangles each, with the normal to the left
/// of the first axis' turn to the second. Cells behind the last node of a periodic axis are there only where they close
/// the surface (period 0), so that nothing reaches across a tile. A line and a block have no triangles.
TriangleMesh mesh_of(const Grid& grid);

/// "uv" that lays an image on a sheet: the texel (i, j) of one with as many as there are nodes on the node (i, j).
Attribute uv_of(const Grid& grid);

/// After which an even grid repeats along x, y and z [world units]; 0 along closed axes, and for other grids.
Point period_of(const Grid& grid);

/// The mean distance of neighbours [world units].
double mean_edge(const Grid& grid);

/// Around the nodes; of an even grid with the cells behind the last nodes of periodic axes.
Box box_of_cells(const Grid& grid);
/// Cells along an axis of a sheet that mesh_of shows.
std::int32_t shown_cells(const Grid& grid, std::size_t axis);

/// An end of an axis by its name.
struct AxisEnd {
  std::size_t axis;
  bool upper;
};
/// "xmin", "xmax", "ymin", ... of the axes that are closed; nothing for another name.
std::optional<AxisEnd> axis_end(const Grid& grid, const std::string& name);
/// The names of all sides of a grid.
std::vector<std::string> axis_ends(const Grid& grid);

/// Error(Fault::input) for counts below 1, fewer than two nodes on the first axis, fewer than three on a periodic one,
/// an axis with an extent behind one without, points or attributes of another number than the nodes, numbers that are
/// not finite, and a spacing that is not greater than 0.
void require_sound(const Grid& grid);

}  // namespace pelage
