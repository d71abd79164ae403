#pragma once
// Systems of several fields that share two symmetric matrices,
//     M x_i + sum_j C_ij K x_j = b_i,     C a small matrix of numbers, K 1 = 0.

#include "linalg/conjugate_gradient.h"

namespace pelage {

/// The real Schur form C = Q T Q' takes the fields apart: from the last component of y = Q' x to the first, a real
/// eigenvalue t of C costs one solve with M + t K by conjugate gradients, and a pair of complex ones a single solve
/// with the complex symmetric M + t K. So a fourth-order term costs one matrix whose condition is the square root of
/// that of the biharmonic operator. Afterwards constants are added so that the equations summed over all rows hold to
/// rounding: what is conserved stays so however loose the tolerance is.
class CoupledSolver {
 public:
  /// Prepares for these matrices; quick where they are the same objects as before.
  void update(std::shared_ptr<const SparseMatrix> mass, std::shared_ptr<const SparseMatrix> stiffness,
              const Eigen::MatrixXd& c);
  /// x holds the first guess and the result, one vector per field. The report adds up iterations and holds the largest
  /// residual; not positive_definite: a real t is so negative that M + t K is indefinite.
  SolveReport solve(const std::vector<Vector>& b, std::vector<Vector>& x, const ConjugateGradientOptions& options = {});

 private:
  /// One or two components of y.
  struct Block {
    Eigen::Index first = 0, size = 1;
    SparseMatrix real;  ///< M + t K
    Jacobi<Vector> preconditioner;
    ComplexMatrix complex;  ///< the same for a complex t, of a pair
    Jacobi<ComplexVector> complex_preconditioner;
    std::complex<double> second;  ///< y_1 + second y_2 is the unknown of the complex system
  };
  Block make_block(Eigen::Index first) const;
  SolveReport solve_real(const Block& block, const Vector& f, Vector& y, const ConjugateGradientOptions& options);
  SolveReport solve_pair(const Block& block, const Vector& f1, const Vector& f2, Vector& y1, Vector& y2,
                         const ConjugateGradientOptions& options);
  std::vector<Vector> rotated(const Eigen::MatrixXd& q, const std::vector<Vector>& fields) const;

  std::shared_ptr<const SparseMatrix> mass_, stiffness_;
  Eigen::MatrixXd c_, q_, t_;
  std::vector<Block> blocks_;  ///< first components first
  Vector integral_;            ///< M 1
  ConjugateGradientWork<Vector> real_work_;
  ConjugateGradientWork<ComplexVector> complex_work_;
};

}  // namespace pelage
