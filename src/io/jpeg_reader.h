#pragma once
// JPEG images, by libjpeg-turbo.

#include <string_view>

#include "io/stored_image.h"

namespace pelage {

bool is_jpeg(std::string_view bytes);

/// Those of image_reader.h, of a file that is_jpeg.
void check_jpeg(std::string_view bytes, const std::string& path);
StoredImage read_jpeg(std::string_view bytes, const std::string& path);

}  // namespace pelage
