#pragma once
// The transfer function of sRGB (IEC 61966-2-1): files of 8 bits and screens hold encoded values,
// everything that is computed here is linear light.

#include <array>
#include <cstdint>

namespace pelage {

/// Linear light in [0, 1] -> sRGB value in [0, 1]; what lies outside is clamped.
double srgb_from_linear(double linear);

/// The inverse, on [0, 1].
double linear_from_srgb(double encoded);

/// sRGB value rounded to 8 bits.
std::uint8_t srgb_byte(double linear);

/// The same for many samples: by tables, without powers.
class SrgbBytes {
 public:
  SrgbBytes();
  std::uint8_t operator()(float linear) const;

 private:
  static constexpr int steps = 4096;
  std::array<std::uint8_t, steps + 1> start_;  ///< bytes of equidistant light
  std::array<float, 257> least_;               ///< light that gives a byte or a higher one; none gives 256
};

}  // namespace pelage
