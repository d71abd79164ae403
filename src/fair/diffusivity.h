#pragma once
// Diffusion that is throttled across edges, of surfaces and of functions on them.

#include <Eigen/Eigenvalues>
#include <cmath>

#include "discretise/assembly.h"

namespace pelage {

/// g(s) of eq. (20) of Bajaj, Zhang, Xu 2008, with |s|: 1 up to lambda, then falling.
inline double throttle(double s, double lambda) {
  const double beyond = (std::abs(s) - lambda) / lambda;
  return beyond <= 0 ? 1 : 1 / (1 + beyond * beyond);
}

/// The sum of g(s_i) e_i e_i' over the eigenvalues s_i and eigenvectors e_i of a symmetric matrix, eq. (19) there.
template <class Diffusivity>
Tensor diffusion_tensor(const Eigen::Matrix3d& matrix, const Diffusivity& g) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(matrix);
  const Eigen::Vector3d values = eigen.eigenvalues().unaryExpr(g);
  const Eigen::Matrix3d d = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
  return {d(0, 0), d(0, 1), d(0, 2), d(1, 1), d(1, 2), d(2, 2)};
}

}  // namespace pelage
