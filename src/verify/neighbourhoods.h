#pragma once
// Small meshes around one triangle: every way in which the corners of a Loop patch can be extraordinary or lie on a
// boundary.

#include <array>
#include <vector>

#include "shape/topology.h"

namespace pelage {

/// A triangle with just the triangles that touch one of its corners. Connectivity only: control values are free.
struct Neighbourhood {
  Topology topology;
  Index face = 0;  ///< the triangle; its first corner is vertex 0
};

/// All corners inside; valences at least 4.
Neighbourhood closed_neighbourhood(const std::array<Index, 3>& valence);

/// One corner inside with valence 3, the others with valence 5 inside a larger mesh.
Neighbourhood valence_three_neighbourhood();

/// Triangle number `position` of the fan of `triangles` faces around a boundary vertex; its other corners lie on the
/// boundary or not, as it comes.
Neighbourhood boundary_neighbourhood(Index triangles, Index position);

/// Valences 3 to 12 beside two regular corners (for valence 3 see above).
std::vector<Neighbourhood> one_extraordinary_corner();
/// Two or three extraordinary corners, and the tetrahedron.
std::vector<Neighbourhood> several_extraordinary_corners();
/// Boundary vertices with one to eight triangles, in every position.
std::vector<Neighbourhood> boundary_corners();
/// All of these.
std::vector<Neighbourhood> all_neighbourhoods();

}  // namespace pelage
