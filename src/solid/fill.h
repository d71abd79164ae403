#pragma once
// Closed surfaces filled with tetrahedra: isosurface stuffing (Labelle, Shewchuk 2007) on a body-centred cubic lattice.

#include <string>

#include "pelage/tet_mesh.h"

namespace pelage {

struct Filling {
  TetMesh volume;
  double edge = 0;  ///< of the lattice, the longest inside [world units]
  double lost = 0;  ///< of the inside of the surface, as a share of it; negative where there is too much
};

/// Fills what a closed surface encloses: where it winds around a place at least once, whether it meets itself or not;
/// components inside an odd number of others are cavities. Nodes of the skin lie on the surface, but for its edges and
/// corners, which are cut off within a tetrahedron, and where parts would touch in an edge alone: there the smaller one
/// ends before. Inside, the nodes are those of the lattice; the skin is closed. All dihedral angles are
/// between 10 and 165 degrees. What is thinner than about `edge`, the longest edge inside [world units], may be lost.
/// Values at vertices and corners (Domain::vertex and corner) are carried: every node has those of the nearest place of
/// the surface. Deterministic for any number of threads.
/// Error(Fault::input) for a surface with holes, and where nothing is left or there would be more than `max_tets`.
Filling fill(const TriangleMesh& closed, double edge, std::size_t max_tets);

/// The same with an edge so much shorter, down to half of it and within `max_tets`, that all but `share` of the volume
/// is there.
Filling fill_within(const TriangleMesh& closed, double edge, double share, std::size_t max_tets);

}  // namespace pelage
