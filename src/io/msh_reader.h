#pragma once
// Gmsh's MSH -> cells of volumes.

#include <string>
#include <string_view>
#include <vector>

#include "shape/solid_cells.h"

namespace pelage {

/// The tetrahedra, pyramids, wedges and hexahedra of a MSH file of version 2 or 4.1, text or binary in either order of
/// bytes; of elements of higher order the corners. Physical groups of volumes are values "group" of the cells, with
/// their names as labels; NodeData and ElementData are values under the name of their view. Findings: elements and
/// groups of surfaces, lines and points, sections, parametric coordinates and partitions, all left out; further groups
/// of an element; all but the last of several steps in time; nodes or cells for which a view has no value (0).
/// Error(Fault::input), with the line or the byte: what is damaged or missing, other versions, unknown elements.
SolidCells read_msh(std::string_view bytes, const std::string& path, std::vector<Finding>& findings);

}  // namespace pelage
