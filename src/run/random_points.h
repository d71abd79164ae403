#pragma once
// Points that keep a distance from each other, where patterns may start: random ones on a surface, and on flat sheets
// those of a grid whose order is disturbed.

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

/// The same for the points of a square grid that stands on its corner, in the plane of x and y: each has four
/// neighbours at `spacing`, a little less or more where whole numbers of diamonds have to fit into the box or the
/// period. Each is moved along x and y by a random number that is even from -`jitter` to `jitter` half spacings. Below
/// 2 everywhere; 0 where there would be more points than positions.
std::vector<double> distance_to_jittered_diamonds(const std::vector<Point>& positions, double spacing, double jitter,
                                                  std::uint64_t seed, const Point& period = {});

}  // namespace pelage
