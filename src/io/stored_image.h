#pragma once
// Images as they are stored, and how many pixels a file may claim.

#include <cstdint>
#include <string>
#include <vector>

namespace pelage {

struct StoredImage {
  int width = 0, height = 0;
  int channels = 0;   ///< 1 grey, 2 grey and alpha, 3 red, green and blue, 4 with alpha
  bool deep = false;  ///< whether the file has 16 bits per channel, and not 8
  /// Pixel (x, y), counted from the top left corner, begins at samples[channels * (y * width + x)]; 65535 stands for 1.
  std::vector<std::uint16_t> samples;
};

/// 16384 x 16384, the largest images that painting programs make: 1.6 GB as 16-bit colours.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

/// What the header of an image file claims.
struct ImageClaim {
  std::int64_t width, height;
  double bits_per_pixel;  ///< the fewest bits that a pixel takes in the file
};

/// Error(Fault::input) if that are more than `most_pixels`, or more than a file of so many bytes can hold: a header
/// must not reserve memory that nothing fills. `path` is for messages.
void require_possible(const ImageClaim& claim, std::size_t file_size, const std::string& path);

/// Error(Fault::input): the file is no image, because of this.
[[noreturn]] void refuse_image(const std::string& why, const std::string& path);

}  // namespace pelage
