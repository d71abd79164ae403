#pragma once
// Drawings of lines as SVG.

#include <string>

#include "shape/line_drawing.h"

namespace pelage {

/// A unit of the file is a millimetre, or 1/1000 of the coordinates of textures. Of every part a group, with its region
/// as one path that is filled by the even-odd rule and its lines as another without a filling; curves that are closed
/// are closed paths.
std::string encode_svg(const LineDrawing& drawing);

}  // namespace pelage
