#pragma once
// How noisy a mesh is, without knowing the surface beneath.

#include "shape/topology.h"

namespace pelage {

/// Standard deviation of the noise along the normals, in world units. At every vertex of valence 6 or more a quadratic
/// height function is fitted to it and its neighbours; what remains is noise where the surface is smooth, and more
/// where it has an edge or a detail. The patch is the smallest that leaves a remainder: on coarse meshes two rings
/// would see more of the shape than of the noise. A quantile of all vertices, divided by that of pure Gaussian noise,
/// leaves the edges out. 0 for a mesh without any such vertex.
double estimate_noise(const Topology& topology, const std::vector<Point>& points);

/// The same for a function with one value per vertex, in its unit.
double estimate_noise(const Topology& topology, const std::vector<Point>& points, const std::vector<double>& values);

}  // namespace pelage
