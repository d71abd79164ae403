#pragma once
// Coats at the nodes of grids and volumes as files: images, VTK's grids and volumes, textures for shaders.

#include <array>
#include <string>
#include <vector>

#include "pelage/grid.h"
#include "pelage/image.h"
#include "pelage/io.h"

namespace pelage {

/// The extensions of files that hold what is at nodes, with the dot.
std::vector<std::string> node_output_extensions();

/// Whether the name ends like that.
bool is_node_output(const std::string& path);

/// Refuses what save_nodes would refuse about the name: Error(Fault::usage) with what can be written of such a shape
/// (null: a surface; of patches their image).
void check_node_output(const std::string& path, const NodeShape* shape);

/// The values at the nodes of a sheet as 16-bit grey. Errors of write_file.
void save_height_map(const Grid& sheet, const std::vector<double>& values, const std::string& path);

/// Even sheets and lines: those whose nodes are shown as they are; and blocks.
bool is_flat(const Grid& grid);

/// A block or tetrahedra.
bool is_volume(const NodeShape* shape);

/// The nodes of such a grid as pixels, `tiles` times across and down, as large as `size` allows; of a block its middle
/// planes.
Image picture_of_nodes(const Grid& grid, const TriangleMesh& coat, const std::array<int, 2>& tiles, int size);
/// The same of grid_image.
Image picture_of_nodes(const Grid& grid, Image image, const std::array<int, 2>& tiles, int size);

/// Writes what the coat has at its vertices, which are the nodes of the shape; of tetrahedra, as .vti and .raw, an even
/// block around them. Says what a program must know to read the file; empty where the file says it. Errors of
/// write_grid and write_tets.
std::string save_nodes(const NodeShape& shape, const TriangleMesh& coat, const std::string& path);

}  // namespace pelage
