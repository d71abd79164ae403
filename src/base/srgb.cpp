#include "base/srgb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pelage {

double srgb_from_linear(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

namespace {

/// Floats in [0, 1] are in order as their bits are.
float least_light_of(int byte) {
  std::uint32_t below = 0, enough = std::bit_cast<std::uint32_t>(1.0F);
  while (enough - below > 1) {
    const std::uint32_t middle = below + (enough - below) / 2;
    (srgb_byte(static_cast<double>(std::bit_cast<float>(middle))) < byte ? below : enough) = middle;
  }
  return std::bit_cast<float>(enough);
}

}  // namespace

std::uint8_t srgb_byte(double linear) { return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(linear))); }

SrgbBytes::SrgbBytes() {
  for (int k = 0; k <= steps; ++k) start_[static_cast<std::size_t>(k)] = srgb_byte(static_cast<double>(k) / steps);
  for (int byte = 1; byte < 256; ++byte) least_[static_cast<std::size_t>(byte)] = least_light_of(byte);
  least_[0] = -std::numeric_limits<float>::infinity();
  least_[256] = std::numeric_limits<float>::infinity();
}

std::uint8_t SrgbBytes::operator()(float linear) const {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  std::size_t byte = start_[static_cast<std::size_t>(x * steps)];
  while (x >= least_[byte + 1]) ++byte;
  return static_cast<std::uint8_t>(byte);
}

}  // namespace pelage
