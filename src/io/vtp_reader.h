#pragma once
// VTK XML PolyData -> polygons, or points.

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// The polygons of a VTP file, or its points where it has none: point data and, of the polygons, cell data become
/// attributes as VtkAttributes reads them. Several pieces follow one another. Findings: triangle strips, lines, and
/// beside polygons vertices, which are left out. Error(Fault::input): what is damaged or missing, hidden cells.
RawShape read_vtp(std::string_view bytes, const std::string& path);

}  // namespace pelage
