#pragma once
// PNG and JPEG images as they are stored.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct StoredImage {
  int width = 0, height = 0;
  int channels = 0;   ///< 1 grey, 2 grey and alpha, 3 red, green and blue, 4 with alpha
  bool deep = false;  ///< whether the file has 16 bits per channel, and not 8
  /// Pixel (x, y), counted from the top left corner, begins at samples[channels * (y * width + x)]; 65535 stands for 1.
  std::vector<std::uint16_t> samples;
};

/// Error(Fault::input) as far as the beginning of the file shows that it is no whole PNG or JPEG image, or has more
/// than 2^28 pixels. `path` is for messages.
void check_image(std::string_view bytes, const std::string& path);

/// The image with so many channels; 0: as many as are stored. Errors as above.
StoredImage read_image(std::string_view bytes, const std::string& path, int channels = 0);

}  // namespace pelage
