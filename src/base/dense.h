/// Small dense matrices. The decompositions are compiled in one place, because their templates cost a compiler minutes.
#pragma once

#include <Eigen/Core>

namespace pelage {

/// Eigenvalues of a square matrix, in no particular order; NaN if the matrix is not finite.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

/// In ascending order; column k of `vectors` belongs to values[k].
struct Modes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// A v = lambda v with a symmetric A, vectors of length 1.
Modes symmetric_modes(const Eigen::MatrixXd& a);
/// A v = lambda B v with a symmetric A and a positive definite B, vectors with v'Bv = 1.
Modes symmetric_modes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// A^-1 B of a square A; not finite if A is singular.
Eigen::MatrixXd solved(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The shortest x that minimises |A x - b|; A may be singular.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace pelage
