#pragma once
// How fine a mesh a pattern gets at least, and what waves such a mesh carries.

namespace pelage {

/// The largest k^2 of Loop elements on an even mesh whose edges are a sixth of the wavelength, the coarsest that a run
/// takes [1 / length^2]. Stability of time steps depends on it. An even mesh of edge h has k^2 = 16 / h^2 (sphere, by
/// power iteration); meshes that are twice as fine have four times as much, very uneven ones or boundaries even more.
constexpr double largest_k2_of_coarsest_mesh(double wavelength) {
  constexpr double vertices_per_wavelength = 6;  // as in operators.cpp
  const double edge = wavelength / vertices_per_wavelength;
  return 16 / (edge * edge);
}

}  // namespace pelage
