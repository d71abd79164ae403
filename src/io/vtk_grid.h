#pragma once
// VTK XML ImageData and StructuredGrid, for ParaView and VTK.

#include <string>

#include "pelage/grid.h"

namespace pelage {

/// The bytes of a VTI file: the nodes by origin and spacing, the attributes as point data with their own types. "color"
/// is RGB or RGBA (sRGB, UInt8, or UInt16 if the attribute is of that type), "normal" Normals, "uv" TextureCoordinates.
/// What VTK does not know is field data: `periodic` (three numbers, 1 for periodic axes, after whose last node VTK
/// shows nothing: no row is written twice), `metres_per_unit`, and NAME_labels. Error(Fault::usage) for a grid with
/// points; Fault::numerics for a value that is not finite.
std::string vti_bytes(const Grid& grid);

/// The bytes of a VTS file: the same with Points (Float32 if they are floats, else Float64), and the field data
/// `period`, three vectors. For even grids, too.
std::string vts_bytes(const Grid& grid);

}  // namespace pelage
