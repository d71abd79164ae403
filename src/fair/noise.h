#pragma once
// How noisy a mesh is, without knowing the surface beneath.

#include "shape/topology.h"

namespace pelage {

/// Standard deviation of the noise along the normals, in world units. At every vertex a quadratic height function is
/// fitted to the two rings around it; what remains is noise where the surface is smooth, and more where it has an edge
/// or a detail. A quantile of all vertices, divided by that of pure Gaussian noise, leaves the edges out. 0 for a mesh
/// too small for any fit.
double estimate_noise(const Topology& topology, const std::vector<Point>& points);

/// The same for a function with one value per vertex, in its unit.
double estimate_noise(const Topology& topology, const std::vector<Point>& points, const std::vector<double>& values);

}  // namespace pelage
