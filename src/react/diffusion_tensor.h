#pragma once
// What makes a symmetric matrix the tensor of a diffusion.

#include <array>

namespace pelage {

/// Whether no direction has a negative diffusion, but for rounding; xx, xy, xz, yy, yz, zz. False for what is not
/// finite.
bool positive_semidefinite(const std::array<double, 6>& tensor);

}  // namespace pelage
