#pragma once
// Coats of blocks as plain texels, for shaders.

#include <string>

#include "pelage/grid.h"

namespace pelage {

/// The "color" of a block as four bytes for each node: red, green and blue (sRGB), and alpha, which is that of the
/// colour, and 0 where an attribute "inside" is 0. x runs fastest, then y, then z; there is no head.
/// Error(Fault::usage) for grids that are no blocks and for blocks without colours; Fault::numerics for a value that is
/// not finite.
std::string raw_texture_bytes(const Grid& block);

/// What a program must know to read it: "64 x 64 x 32 texels of 4 bytes, ...".
std::string raw_texture_form(const Grid& block);

}  // namespace pelage
