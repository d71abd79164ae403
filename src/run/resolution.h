#pragma once
// How fine a mesh a pattern gets at least, and what waves such a mesh carries.

namespace pelage {

/// The largest k^2 of Loop elements on an even mesh with so many vertices per wavelength (`resolution`), the coarsest
/// that a run takes [1 / length^2]. Stability of time steps depends on it. An even mesh of edge h has k^2 = 16 / h^2
/// (sphere, by power iteration); meshes that are twice as fine have four times as much, very uneven ones or boundaries
/// even more.
constexpr double largest_k2_of_coarsest_mesh(double wavelength, double resolution) {
  const double edge = wavelength / resolution;
  return 16 / (edge * edge);
}

}  // namespace pelage
