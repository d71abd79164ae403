#pragma once
// Where places lie in a volume.

#include <array>
#include <vector>

#include "pelage/tet_mesh.h"

namespace pelage {

/// Four nodes and what each of them counts, 1 together: a function that is linear in tetrahedra has the value
/// sum share[k] f(node[k]) there.
struct TetPlace {
  Tetrahedron node;
  std::array<double, 4> share;
};

/// Of each place the tetrahedron that it lies in, or outside of all the nearest place of the skin. Of several that meet
/// there, the first. Deterministic for any number of threads.
std::vector<TetPlace> places_in(const TetMesh& volume, const std::vector<Point>& places);

}  // namespace pelage
