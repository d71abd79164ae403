#pragma once
// OFF (text), with the variants COFF, NOFF, STOFF and their combinations.

#include <string>
#include <string_view>

#include "io/raw_shape.h"

namespace pelage {

/// Reads the vertices and faces of an OFF file; edges are not stored in it. The data may stand one element a line or
/// packed. Attributes: "color" from C (sRGB 0..1 or 0..255; 3 or 4 values) or from the faces ("face_color" where the
/// vertices have one, too), "normal" from N, "uv" from ST. Throws Error(Fault::input) with file and line.
RawShape read_off(std::string_view bytes, const std::string& path);

}  // namespace pelage
