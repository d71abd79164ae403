#pragma once
// PNG images, by libspng.

#include <string_view>

#include "io/stored_image.h"

namespace pelage {

bool is_png(std::string_view bytes);

/// Those of image_reader.h, of a file that is_png.
void check_png(std::string_view bytes, const std::string& path);
StoredImage read_png(std::string_view bytes, const std::string& path);

}  // namespace pelage
