#pragma once
// Points that repel each other until they are spread evenly (Turk 1991, section 4).

#include <vector>

#include "shape/cell_ground.h"

namespace pelage {

/// n places on the ground, at random and then relaxed: within `radius` they repel each other with a force that falls
/// linearly to 0. The same for any number of threads.
std::vector<CellPlace> relaxed_places(const CellGround& ground, std::size_t n, double radius);

}  // namespace pelage
