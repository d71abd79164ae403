#pragma once
// Spots and their neighbours.

#include <span>
#include <vector>

#include "pelage/measure.h"

namespace pelage {

/// Of the connected parts where a function is above a level, or below it. Their centres are the vertices nearest to
/// the centroids; their cells grow on the surface to where another centre is nearer, in a straight line. On a closed
/// surface whose cells are discs, the sum of 6 - n over the spots with n neighbours is 6 times Euler's characteristic.
Spots find_spots(const TriangleMesh& mesh, const std::vector<double>& values, double level, bool above);

/// Mean distance from a place to the nearest other one, straight; 0 where there are not two [world units].
double mean_nearest(std::span<const Point> places);

}  // namespace pelage
