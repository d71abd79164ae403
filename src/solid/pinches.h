#pragma once
// Where two parts of a volume touch in an edge alone.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pelage {

/// Takes tetrahedra away until no edge of the skin has more than two of its triangles: of the parts that meet in such
/// an edge, each joined by faces around it, the largest stays. `may_be_skin` says of nodes whether they can be nodes of
/// the skin, `volume` gives that of a tetrahedron. The others keep their order. How many were taken away.
std::size_t remove_pinches(std::vector<std::array<std::int64_t, 4>>& tets,
                           const std::function<bool(std::int64_t)>& may_be_skin,
                           const std::function<double(const std::array<std::int64_t, 4>&)>& volume);

}  // namespace pelage
