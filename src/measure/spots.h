#pragma once
// Spots and their neighbours.

#include <map>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

struct Spots {
  std::size_t count = 0;
  double diameter = 0;  ///< mean of those of discs of the same area [world units]
  double nearest = 0;   ///< mean distance from the centre of a spot to the nearest other one [world units]
  /// How many spots have how many neighbours: the triangles of Delaunay's triangulation at them. Spots whose cells
  /// reach the border of the surface are left out.
  std::map<std::size_t, std::size_t> neighbours;
};

/// Of the connected parts where a function is above a level, or below it. Their centres are the vertices nearest to
/// the centroids; their cells grow on the surface to where another centre is nearer, in a straight line. On a closed
/// surface whose cells are discs, the sum of 6 - n over the spots with n neighbours is 6 times Euler's characteristic.
Spots find_spots(const TriangleMesh& mesh, const std::vector<double>& values, double level, bool above);

/// Mean distance from a place to the nearest other one, straight; 0 where there are not two [world units].
double mean_nearest(std::span<const Point> places);

}  // namespace pelage
