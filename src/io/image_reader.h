#pragma once
// PNG and JPEG images as they are stored.

#include <string>
#include <string_view>

#include "io/stored_image.h"

namespace pelage {

/// Error(Fault::input) as far as the header of the file shows that it is no PNG or JPEG image, or has more than 2^28
/// pixels, or more than so few bytes can hold. `path` is for messages.
void check_image(std::string_view bytes, const std::string& path);

/// The image with so many channels, 3 (alpha is dropped, grey repeated) or 0: as many as are stored.
/// Error(Fault::input) as above, or if the file is damaged or ends early.
StoredImage read_image(std::string_view bytes, const std::string& path, int channels = 0);

}  // namespace pelage
