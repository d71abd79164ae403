#pragma once
// Files of lines: drawings, and lines in space.

#include <string>
#include <vector>

#include "shape/line_drawing.h"

namespace pelage {

/// Of drawings (.svg, .dxf) and of lines in space (.obj, .vtp).
std::vector<std::string> drawing_extensions();
std::vector<std::string> space_line_extensions();

/// Error(Fault::output) when the file cannot be written. The extension is one of the above.
void write_lines(const LineDrawing& drawing, const std::string& path);
void write_lines(const std::vector<SpaceLines>& lines, const std::string& path);

/// OBJ with elements `l`, an object for each kind of lines.
std::string encode_line_obj(const std::vector<SpaceLines>& lines);
/// VTK XML with Lines; "isoline" in their cells is the number of their kind, whose name is in isoline_labels.
std::string encode_line_vtp(const std::vector<SpaceLines>& lines);

}  // namespace pelage
