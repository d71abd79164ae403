#pragma once
// Vertices on their way, as far as the surface does not meet itself.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

/// The vertices of a surface before they move, and how each of them is to move.
struct Departure {
  std::vector<Point> from, way;
};

/// Where they are after that share of their ways, one per vertex.
std::vector<Point> moved(const Departure& departure, const std::vector<double>& share);

/// The share of its way that each vertex can go: 1 where nothing is in the way. Where triangles meet, or turn over, it
/// is halved until they do not, at most twelve times, and grows from there by no more than the distance over the
/// longest way. Triangles that are marked as `given` up are left as they are: those that met before anything moved.
std::vector<double> shares_apart(const std::vector<Triangle>& triangles, const Departure& departure,
                                 const std::vector<char>& given);

}  // namespace pelage
