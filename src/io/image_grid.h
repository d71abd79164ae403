#pragma once
// Pictures as sheets, and sheets as pictures.

#include <string>
#include <string_view>

#include "io/grid_file.h"

namespace pelage {

/// A PNG or JPEG image as an even grid: its pixels are the nodes, one world unit apart, the first one below on the left
/// at the origin and y upwards. "color" holds what they show, grey as three equal channels, with the type of the file
/// (uint8 or uint16), and a fourth component where alpha is not 1 everywhere. A finding says what a unit is. Errors as
/// read_image; images of one pixel's width are refused.
GridFile image_grid(std::string_view bytes, const std::string& path);

/// The other way: the "color" of a sheet or a line as a PNG image, with 16 bits per channel where the attribute is of
/// that type, else 8. Error(Fault::usage) for a block and for a grid without colours; Fault::numerics for a value that
/// is not finite.
std::string grid_png_bytes(const Grid& grid);

/// All attributes of a sheet or a line as an EXR image: "color" as R, G, B and A, the components of others as NAME or
/// NAME_1, NAME_2, ... Errors as above and those of exr_bytes.
std::string grid_exr_bytes(const Grid& grid);

}  // namespace pelage
