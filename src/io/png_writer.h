#pragma once
// Pictures with 16 bits per channel, and what can be known before a picture is written (pelage/io.h).

#include <cstdint>
#include <string>
#include <vector>

#include "pelage/image.h"

namespace pelage {

/// The bytes of a PNG file with 16 bits per channel, sRGB; else as png_bytes (pelage/io.h). `path` is for messages.
std::string deep_png_bytes(const Image& image, const std::string& path = "");

/// The bytes of a PNG file of numbers: grey with 16 bits, stored as they are. Pixel (x, y), counted from the top left
/// corner, is grey[y * width + x].
std::string grey_png_bytes(int width, int height, const std::vector<std::uint16_t>& grey, const std::string& path = "");

/// Refuses a name that does not end in .png (Fault::usage) or whose folder cannot be written to
/// (Fault::output): to be asked before the picture is made.
void check_picture_path(const std::string& path);

/// Refuses a picture of so many pixels that its file could not be written (Fault::usage): the same.
void check_picture_size(std::int64_t width, std::int64_t height, const std::string& path);

}  // namespace pelage
