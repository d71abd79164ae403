#include "base/srgb.h"

#include <algorithm>
#include <cmath>

namespace pelage {

double srgb_from_linear(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::uint8_t srgb_byte(double linear) { return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(linear))); }

}  // namespace pelage
