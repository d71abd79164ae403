#pragma once
// Pictures as plain arrays.

#include <vector>

namespace pelage {

/// A picture in linear light. Pixel (x, y), counted from the top left corner, holds its red, green and
/// blue at rgb[3 * (y * width + x)] and the two places after it; 1 is the white of the screen.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;  ///< 3 * width * height
};

}  // namespace pelage
