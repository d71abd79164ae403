#pragma once
// STL (text and binary).

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads the facets of an STL file, every corner a vertex of its own: the repair welds them. Binary files are
/// told by their length, as many begin with "solid" too. Attributes, per face:
///   "color"   from the attribute bytes as Magics and as VisCAM, SolidView and others write them
///   "object"  the solid of a text file that has several, labelled with their names
/// The order of the corners says where outside is; normals that say otherwise are findings.
/// Throws Error(Fault::input) with file and line or facet.
RawShape read_stl(std::string_view bytes, const std::string& path);

}  // namespace pelage
