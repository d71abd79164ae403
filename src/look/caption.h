#pragma once
// A picture with words below it.

#include <string>

#include "pelage/image.h"

namespace pelage {

/// The picture on a sheet with two lines of text under it; lines that are too long are cut short with dots.
/// Higher by `caption_height` pixels.
Image with_caption(const Image& picture, const std::string& title, const std::string& subtitle);

int caption_height(int width);

}  // namespace pelage
