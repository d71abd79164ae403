#pragma once
// Volumes and angles of tetrahedra.

#include <array>
#include <utility>

#include "pelage/tet_mesh.h"

namespace pelage {

/// (b - a) x (c - a) . (d - a) / 6.
double signed_volume(const Point& a, const Point& b, const Point& c, const Point& d);

/// Of all tetrahedra together [world units^3].
double volume_of(const TetMesh& mesh);

/// The smallest and the largest angle between two of the four faces [degrees].
std::pair<double, double> dihedral_angles(const std::array<Point, 4>& corners);

/// The same of all tetrahedra; (180, 0) for none.
std::pair<double, double> dihedral_angles(const TetMesh& mesh);

}  // namespace pelage
