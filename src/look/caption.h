#pragma once
// A picture with words below it.

#include <string>

#include "shape/image.h"

namespace pelage {

/// The picture on a sheet with two lines of text under it; lines that are too long are cut short with dots.
Image with_caption(const Image& picture, const std::string& title, const std::string& subtitle);

}  // namespace pelage
