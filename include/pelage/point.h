#pragma once
// Places in space.

#include <array>

namespace pelage {

using Point = std::array<double, 3>;  ///< x, y, z in world units

}  // namespace pelage
