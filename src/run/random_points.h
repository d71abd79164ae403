#pragma once
// Random points on a surface that keep a distance from each other: where patterns may start.

#include <cstdint>
#include <vector>

#include "pelage/point.h"

namespace pelage {

/// Name of the vertex attribute that formulas read as `points`.
inline constexpr const char* points_attribute = "points";

/// Chooses among `positions`, in an order that depends on the seed and on where they lie in their box, all that are at
/// least `spacing` away from those chosen before (dart throwing: a maximal Poisson-disk sample). For every position the
/// straight distance to the nearest chosen one, in units of the spacing: below 1 everywhere. `period`: after which
/// space repeats along x, y and z; 0: never.
std::vector<double> distance_to_random_points(const std::vector<Point>& positions, double spacing, std::uint64_t seed,
                                              const Point& period = {});

}  // namespace pelage
