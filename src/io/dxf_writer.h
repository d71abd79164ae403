#pragma once
// Drawings of lines as DXF.

#include <string>

#include "shape/line_drawing.h"

namespace pelage {

/// Text of release 12, which machines and programs of all ages read: the lines as POLYLINE, closed ones marked as such,
/// each part on a layer. Units are millimetres, or coordinates of textures.
std::string encode_dxf(const LineDrawing& drawing);

}  // namespace pelage
