#pragma once
// Images that are laid on meshes by their uv.

#include <cstdint>
#include <memory>
#include <vector>

namespace pelage {

/// Bytes of pixels. Pixel (x, y), counted from the top left corner, has its channels from
/// bytes[channels * (y * width + x)] on.
struct Pixels {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> bytes;
};

/// The images of a material, all of one size; what is null is not there. Greys are numbers from 0 to 1.
struct TextureMaps {
  std::shared_ptr<const Pixels> color;                           ///< sRGB, three channels
  std::shared_ptr<const Pixels> normal = {};                     ///< in tangent space, green to where v grows
  std::shared_ptr<const Pixels> roughness = {}, metalness = {};  ///< one channel
  std::shared_ptr<const Pixels> opacity = {};                    ///< one channel
  std::shared_ptr<const Pixels> emission = {};                   ///< sRGB, three channels
  std::shared_ptr<const Pixels> transmission = {};               ///< one channel
  std::shared_ptr<const Pixels> thickness = {};                  ///< one channel
  double emission_strength = 1;                                  ///< the light of white texels of the emission
  double deepest = 1;                                            ///< thickness of white texels [units of the mesh]
};

}  // namespace pelage
