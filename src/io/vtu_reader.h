#pragma once
// VTK XML UnstructuredGrid -> cells of volumes.

#include <string>
#include <string_view>
#include <vector>

#include "shape/solid_cells.h"

namespace pelage {

/// The tetrahedra, pyramids, wedges, voxels and hexahedra of a VTU file with point and cell data; of cells of higher
/// order the corners. Several pieces are joined at nodes in exactly the same place. Findings: cells of surfaces and
/// lines, which are left out, nodes between corners, field data that are left out, and those of VtkAttributes.
/// Error(Fault::input): what is damaged or missing, hidden cells, cells of other kinds, other kinds of VTK files.
SolidCells read_vtu(std::string_view bytes, const std::string& path, std::vector<Finding>& findings);

}  // namespace pelage
