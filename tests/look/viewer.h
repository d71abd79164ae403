#pragma once
// What is painted so that it can be measured, and what a viewer of images sees of it.

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "pelage/image.h"
#include "pelage/recipe.h"
#include "pelage/texture_maps.h"

namespace pelage {

/// White paint as thick as the formula says, on black: its values are linear light.
inline Look painted(const std::string& formula) {
  Look look;
  look.layers.resize(2);
  look.layers[0].color = {"#000000", {}};
  look.layers[1].color = {"#ffffff", {}};
  look.layers[1].opacity = {formula, {}};
  return look;
}

/// Between the middles of the texels of an image, whose linear light is light(column, row).
template <class Light>
double between_texels(int width, int height, double u, double v, const Light& light) {
  const double x = u * width - 0.5, y = (1 - v) * height - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  double sum = 0;
  for (const int di : {0, 1})
    for (const int dj : {0, 1})
      sum += (di ? x - i : 1 - x + i) * (dj ? y - j : 1 - y + j) *
             light(static_cast<std::size_t>(std::clamp(i + di, 0, width - 1)),
                   static_cast<std::size_t>(std::clamp(j + dj, 0, height - 1)));
  return sum;
}

/// The red, or what grey there is.
inline double seen(const Pixels& image, double u, double v) {
  return between_texels(image.width, image.height, u, v, [&](std::size_t column, std::size_t row) {
    return linear_from_srgb(image.bytes[static_cast<std::size_t>(image.channels) * (row * image.width + column)] /
                            255.0);
  });
}
inline double seen(const Image& image, double u, double v) {
  return between_texels(image.width, image.height, u, v, [&](std::size_t column, std::size_t row) {
    return image.rgb[3 * (row * static_cast<std::size_t>(image.width) + column)];
  });
}

}  // namespace pelage
