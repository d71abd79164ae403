#pragma once
// VTK XML UnstructuredGrid, for ParaView and VTK.

#include <string>

#include "pelage/tet_mesh.h"

namespace pelage {

/// The bytes of a VTU file: Points (Float32 if they are floats, else Float64), tetrahedra, and the attributes as point
/// data in the way of VTI (io/vtk_grid.h), the field data `metres_per_unit` and NAME_labels among them.
/// Error(Fault::numerics) for a value that is not finite.
std::string vtu_bytes(const TetMesh& volume);

}  // namespace pelage
