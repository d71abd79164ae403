#pragma once
// The elements of an even grid (discretise/grid_cells.h) written down: what a node sees of its neighbours.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "discretise/lattice.h"

namespace pelage {

/// Weights of the neighbours at steps from -1 to 1 along each axis; that of the step (i, j, k) has the number
/// (i + 1) + 3 (j + 1) + 9 (k + 1), and the node itself 0: they belong to differences from it. Borders are mirrors.
struct LatticeStencil {
  std::array<double, 27> diffusion{};   ///< -L^-1 K for a constant tensor, which is div T grad [1/time]
  std::array<double, 27> correction{};  ///< E = I - L^-1 M, with the row sums L of the mass M
};

LatticeStencil lattice_stencil(const Lattice& lattice, const Eigen::Matrix3d& tensor);

/// The largest eigenvalue of -(I + E + ... + E^sweeps) (-L^-1 K) over all waves [1/time].
double largest_rate(const LatticeStencil& stencil, int sweeps);

/// Whether a tensor has a mixed term at a closed border: mirrors do not keep it.
bool tilted_to_a_border(const Lattice& lattice, const Eigen::Matrix3d& tensor);

}  // namespace pelage
