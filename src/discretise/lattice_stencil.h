#pragma once
// Diffusion on an even grid without matrices: what a node sees of its neighbours.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "discretise/lattice.h"

namespace pelage {

/// (D u)(x) = sum of weight (u(x + step) + u(x - step) - 2 u(x)), which is div T grad u for a constant tensor T to the
/// fourth order of the spacing [1/time]: second differences at one and two steps along the axes, and for mixed terms
/// along the diagonals, as 4 d_x d_y = (d_x + d_y)^2 - (d_x - d_y)^2. Borders are mirrors.
/// Along an axis that is (I + E) (-L^-1 K) of the elements (discretise/grid_cells.h, E = I - L^-1 M) literally; in the
/// plane and in space products of differences across each other are left out, of sixth order.
struct LatticeStencil {
  struct Opposite {
    std::array<int, 3> step;
    double weight;
  };
  std::vector<Opposite> neighbours;  ///< steps are the same for all tensors on a lattice
};

LatticeStencil lattice_stencil(const Lattice& lattice, const Eigen::Matrix3d& tensor);

/// The largest eigenvalue of -D over all waves [1/time].
double largest_rate(const LatticeStencil& stencil);

/// Whether a tensor has a mixed term at a closed border: mirrors do not keep it.
bool tilted_to_a_border(const Lattice& lattice, const Eigen::Matrix3d& tensor);

}  // namespace pelage
