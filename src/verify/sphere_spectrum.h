#pragma once
// The spectrum of a field on the unit sphere.

#include <vector>

#include "linalg/sparse.h"
#include "pelage/point.h"

namespace pelage {

/// Power of a field in each degree of spherical harmonics: entry l is the sum over m = -l .. l of the squares of
/// sum_i weight_i value_i Y_lm(place_i), with real orthonormal Y_lm, for l = 0 .. max_degree.
/// `place`: points of the unit sphere; `weight`: areas (their sum is 4 pi).
std::vector<double> power_by_degree(const std::vector<Point>& place, const Vector& weight, const Vector& value,
                                    int max_degree);

}  // namespace pelage
