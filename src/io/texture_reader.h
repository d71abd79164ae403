#pragma once
// PNG and JPEG images -> textures.

#include <string>

#include "shape/texture.h"

namespace pelage {

/// The image, or the base colour of a glTF file if that has a single one, with an empty name: 8 or 16 bits per channel,
/// as stored; alpha is left out, grey becomes three equal channels. Error(Fault::input) for a file that cannot be read,
/// is no whole PNG or JPEG image, or has more than 2^28 pixels.
Texture read_texture(const std::string& path);

/// The same errors as far as the beginning of the file shows them: to be asked before long work.
void check_texture(const std::string& path);

}  // namespace pelage
