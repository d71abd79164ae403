#pragma once
// The even grid that a space lives on, for steppers that need no more of it.

#include <array>
#include <cstddef>

namespace pelage {

/// Unknowns are the values at the nodes of an even grid (pelage/grid.h), one after the other along the first axis.
/// Borders of closed axes are mirrors: through them goes no flux, and the nodes on them have half a cell.
struct Lattice {
  std::array<std::size_t, 3> count{1, 1, 1};
  std::array<bool, 3> periodic{};
  std::array<double, 3> spacing{1, 1, 1};  ///< [world units]

  bool operator==(const Lattice&) const = default;
  std::size_t nodes() const { return count[0] * count[1] * count[2]; }
};

}  // namespace pelage
