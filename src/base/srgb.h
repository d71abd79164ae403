#pragma once
// The transfer function of sRGB (IEC 61966-2-1): files of 8 bits and screens hold encoded values,
// everything that is computed here is linear light.

#include <cstdint>

namespace pelage {

/// Linear light in [0, 1] -> sRGB value in [0, 1]; what lies outside is clamped.
double srgb_from_linear(double linear);

/// The inverse, on [0, 1].
double linear_from_srgb(double encoded);

/// sRGB value rounded to 8 bits.
std::uint8_t srgb_byte(double linear);

}  // namespace pelage
