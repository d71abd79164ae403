#pragma once
// Volumes and angles of tetrahedra.

#include <array>
#include <utility>

#include "pelage/tet_mesh.h"

namespace pelage {

/// (b - a) x (c - a) . (d - a) / 6.
double signed_volume(const Point& a, const Point& b, const Point& c, const Point& d);

/// What each corner counts at a place in a tetrahedron, 1 together: linear, and negative beyond the opposite side.
std::array<double, 4> shares_in(const std::array<Point, 4>& corners, const Point& place);

/// Of all tetrahedra together [world units^3].
double volume_of(const TetMesh& mesh);

/// The smallest and the largest angle between two of the four faces [degrees].
std::pair<double, double> dihedral_angles(const std::array<Point, 4>& corners);

/// The same of all tetrahedra; (180, 0) for none.
std::pair<double, double> dihedral_angles(const TetMesh& mesh);

}  // namespace pelage
