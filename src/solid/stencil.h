#pragma once
// What is left of a tetrahedron of the lattice inside a surface (Labelle, Shewchuk 2007: Isosurface stuffing, figure
// 3).

#include <array>
#include <cstdint>
#include <vector>

namespace pelage {

enum class Side : std::int8_t { outside = -1, on = 0, inside = 1 };

/// A corner of a cut tetrahedron: a node, where both ends are the same, or the cut between two nodes.
struct StencilPoint {
  std::int8_t a, b;  ///< 0 .. 3, a <= b
};
using StencilTet = std::array<StencilPoint, 4>;

/// The tetrahedra that a lattice tetrahedron leaves inside. Its corners 0 and 1 are joined by a long edge, 2 and 3 by
/// the other; `even` says which corners are even in the lattice. Where four cuts bound it, `first_diagonal` (which
/// neighbours do not see) splits them between the cuts 02 and 13, or between what is in their place, else the other
/// way.
void cut_tetrahedron(const std::array<Side, 4>& side, const std::array<bool, 4>& even, bool first_diagonal,
                     std::vector<StencilTet>& result);

}  // namespace pelage
