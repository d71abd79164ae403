#pragma once
// PNG, 8 bits per channel.

#include <cstdint>
#include <string>

#include "shape/image.h"

namespace pelage {

/// Writes the picture as sRGB; values outside [0, 1] are clamped. The file appears whole or not at all.
/// Errors: Fault::numerics for a pixel that is not finite, Fault::output when the file cannot be written, those of
/// check_picture_size.
void write_png(const Image& image, const std::string& path);

/// Refuses a name that does not end in .png (Fault::usage) or whose folder cannot be written to
/// (Fault::output): to be asked before the picture is made.
void check_picture_path(const std::string& path);

/// Refuses a picture of so many pixels that its file could not be written (Fault::usage): the same.
void check_picture_size(std::int64_t width, std::int64_t height, const std::string& path);

}  // namespace pelage
