#pragma once
// A system linearised about a uniform steady state, and what a scheme makes of its waves.

#include <Eigen/Core>

namespace pelage {

/// du'/dt = (J - k^2 D) u' for the amplitudes u' of a wave with wave number k. Model units.
struct Linearisation {
  Eigen::MatrixXd jacobian;   ///< dR_i/du_j; for an algebraic species R is its formula minus itself
  Eigen::MatrixXd diffusion;  ///< D_ij
  Eigen::VectorXd c2;         ///< of the split R_i = C2_i u_i + C3_i
  Eigen::VectorXd evolving;   ///< 1, or 0 for an algebraic species
  double growth = 0;          ///< of the fastest wave, at least 0
};

/// One step of a scheme as a matrix on the amplitudes (of as many states as it remembers); `decay` = k^2 D.
using Amplification = Eigen::MatrixXd(const Linearisation& linearisation, double dt, const Eigen::MatrixXd& decay);

/// Of steppers that are no scheme for the course of time: no step is too long.
inline Eigen::MatrixXd amplify_nothing(const Linearisation& l, double, const Eigen::MatrixXd&) {
  return Eigen::MatrixXd::Zero(l.jacobian.rows(), l.jacobian.cols());
}

}  // namespace pelage
