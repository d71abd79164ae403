#pragma once
// PLY (text and both binary forms).

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads the elements vertex, face (vertex_indices or vertex_index) and tristrips (-1 ends a strip), in any
/// order and with properties of any type; other elements are skipped. Attributes:
///   "color"  red green blue (alpha); sRGB for integer types, linear for float and double
///   "uv"     s t, u v or texture_u texture_v at the vertices, or the face list texcoord at the corners
///   NAME     every other property of the vertices but nx ny nz, one component
/// In the text form every element stands on a line of its own; values behind the promised ones are skipped
/// and reported. Throws Error(Fault::input) with file and line or element.
RawShape read_ply(std::string_view bytes, const std::string& path);

}  // namespace pelage
