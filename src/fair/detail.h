#pragma once
// Details of the shape that a filter took off along with the noise.

#include <vector>

#include "shape/topology.h"

namespace pelage {

/// Moves the vertices part of the way back from `points` to `from` where the filter took off more than noise. What
/// noise moves at a vertex says nothing about its neighbours; if the squared way along the normals can be foretold from
/// the ways around (slope of the regression over two rings), and only then, what goes beyond the way of noise is taken
/// for detail, and its share in the squared way is given back (James, Stein 1961). Fixed vertices do not count.
void give_back_detail(const Topology& topology, const std::vector<char>& fixed, const std::vector<Point>& from,
                      std::vector<Point>& points);

}  // namespace pelage
