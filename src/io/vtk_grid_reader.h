#pragma once
// VTK XML ImageData and StructuredGrid -> grids.

#include <string>
#include <string_view>

#include "io/grid_file.h"

namespace pelage {

/// The grid of a VTI or VTS file: point data become attributes, RGB and RGBA (sRGB) "color", Normals "normal",
/// TextureCoordinates "uv"; field data as vtk_grid.h writes them are honoured. Several pieces are joined. Axes with one
/// node are left out; where the others then are not x, y and z, or the image is turned (Direction), the grid has
/// points. Findings: data of cells and field data that are left out, 64 bit integers, values that are not finite.
/// Error(Fault::input): what is damaged or missing, hidden nodes, other kinds of VTK files.
GridFile read_vtk_grid(std::string_view bytes, const std::string& path);

}  // namespace pelage
