#pragma once
// Wavefront OBJ (text).

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads v (x y z, x y z w, x y z r g b), vt, vn, f, o, g, usemtl, s and mtllib; other statements are findings. Indices
/// may count back from the last vertex (-1). Attributes:
///   "color"           r g b of the vertices (sRGB 0..1, or 0..255 if a value exceeds 1), white where there is none
///   "color", "mask"   also those of ZBrush, in comments #MRGB (0 to 255)
///   "uv", "normal"    vt and vn at the corners, 0 where a corner has none
///   "object", "group", "material"  per face, labelled; without a label before the first o, g or usemtl
///   "smoothing"       s per face, if any is not off
///   "material_color"  per face: Kd of the material library (sRGB in the file), white where there is none
/// Throws Error(Fault::input) with file and line for what is not a number, index 0 and missing vt.
RawShape read_obj(std::string_view bytes, const std::string& path);

}  // namespace pelage
