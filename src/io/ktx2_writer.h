#pragma once
// KTX2, Khronos' file of a texture with its mip levels: here plain bytes, which every program that reads KTX2 can read.

#include <string>
#include <vector>

#include "pelage/texture_maps.h"

namespace pelage {

/// Colours (sRGB, three channels) as R8G8B8A8_SRGB with the alpha 1; `levels` from the largest on, each with half as
/// many texels along a side as the one before, rounded down and at least one.
std::string ktx2_bytes(const std::vector<const Pixels*>& levels);

}  // namespace pelage
