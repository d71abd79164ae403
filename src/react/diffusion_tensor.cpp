#include "react/diffusion_tensor.h"

#include <algorithm>
#include <cmath>

namespace pelage {

/// No principal minor is negative.
bool positive_semidefinite(const std::array<double, 6>& tensor) {
  double size = 0;
  for (const double entry : tensor) size = std::max(size, std::isfinite(entry) ? std::abs(entry) : INFINITY);
  if (!std::isfinite(size)) return false;
  if (size == 0) return true;
  constexpr double rounding = 1e-12;  // of sums of a few products that are at most 1
  const auto positive = [](double minor) { return minor >= -rounding; };
  const double xx = tensor[0] / size, xy = tensor[1] / size, xz = tensor[2] / size, yy = tensor[3] / size,
               yz = tensor[4] / size, zz = tensor[5] / size;
  return positive(xx) && positive(yy) && positive(zz) && positive(xx * yy - xy * xy) && positive(xx * zz - xz * xz) &&
         positive(yy * zz - yz * yz) &&
         positive(xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz));
}

}  // namespace pelage
