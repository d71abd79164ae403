#pragma once
// Order statistics.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pelage {

/// The value below which `share` of the values lie, the nearest one where it falls between two; 0.5: the median.
/// Reorders the values, of which there must be some.
inline double quantile(std::vector<double>& values, double share) {
  assert(!values.empty());
  const auto nth = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace pelage
