#pragma once
// Coats on grids as files: images and VTK's grids.

#include <array>
#include <string>
#include <vector>

#include "look/palette.h"
#include "pelage/grid.h"
#include "pelage/image.h"

namespace pelage {

/// The extensions of files that hold a grid, with the dot.
std::vector<std::string> grid_output_extensions();

/// Whether the name ends like that.
bool is_grid_output(const std::string& path);

/// Refuses what save_grid would refuse about the name, and shapes that are no grids: Error(Fault::usage); Error
/// (Fault::output) for folders.
void check_grid_output(const std::string& path, const std::string& shape);

/// Even sheets and lines, and blocks: those whose nodes are shown as they are.
bool is_flat(const Grid& grid);

/// The nodes of such a grid as pixels, `tiles` times across and down, as large as `size` allows; of a block its middle
/// planes.
Image picture_of_nodes(const Grid& grid, const TriangleMesh& coat, const std::array<int, 2>& tiles, int size);

/// The coat as a surface: that of a block where the shown species is halfway between its lowest and highest values.
TriangleMesh surface_of(const Grid& coat, const TriangleMesh& mesh, const Paint& paint);

/// Errors of write_grid.
void save_grid(const Grid& coat, const std::string& path);

}  // namespace pelage
