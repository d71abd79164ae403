#pragma once
// Where the edges of a lattice pass through a closed surface, and what that says of its nodes. The tests whether a line
// meets a triangle are exact on coordinates that are rounded to less than 1e-4 of an edge: no line slips through
// between two triangles, and every node has a whole winding number.

#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "solid/bcc_lattice.h"

namespace pelage {

struct LatticeCrossing {
  std::int64_t edge = 0;      ///< of the lattice
  double along = 0;           ///< from its lower end, 0 .. 1
  std::int32_t triangle = 0;  ///< of the surface
  std::int8_t turn = 0;       ///< what the winding number gains on the way up
};

struct LatticeCrossings {
  std::vector<LatticeCrossing> ordered;  ///< by edges, and along them
  double volume = 0;                     ///< of all components, cavities negative [world units^3]
};

/// Of a surface without holes, which may meet itself, within the lattice. Every
/// component counts as turned outward, but one that lies in the inside of an odd number of others is a cavity.
LatticeCrossings crossings(const BccLattice& lattice, const TriangleMesh& closed);

/// Of all nodes, from the crossings along x: above 0 inside.
std::vector<std::int8_t> winding_numbers(const BccLattice& lattice, const std::vector<LatticeCrossing>& crossings);

/// Of what is inside, also where components meet, from the crossings along x: sums of lengths times the area for which
/// a line stands.
double volume_along_lines(const BccLattice& lattice, const std::vector<LatticeCrossing>& crossings);

/// On an edge with one end inside: where the surface is next to this end, as a fraction from the lower end. `of_edge`
/// are its crossings, upwards.
double cut_of(std::span<const LatticeCrossing> of_edge, int winding_at_lower_end);

}  // namespace pelage
