#pragma once
// Wavefront OBJ (text).

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads v (x y z, x y z w, x y z r g b), vt and f; other statements are skipped. Indices may
/// count back from the last vertex (-1). Attributes: "color" from r g b (sRGB 0..1, or 0..255 if a value
/// exceeds 1; kept if every vertex has it), "uv" at the corners from vt (0 where a corner has none).
/// Throws Error(Fault::input) with file and line for what is not a number, index 0 and missing vt.
RawShape read_obj(std::string_view bytes, const std::string& path);

}  // namespace pelage
