#include <gtest/gtest.h>

#include <Eigen/LU>

#include "base/parallel.h"
#include "linalg/conjugate_gradient.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::chain;
using testing::dense;
using testing::random_vector;
using Complex = std::complex<double>;

struct System {
  System(std::int32_t n, Complex t) : mass(chain(n, 4)), stiffness(chain(n, 2)) {
    stiffness.pattern = mass.pattern;
    combine(mass, t, stiffness, matrix);
    b = random_vector(n, 1) + Complex(0, 1) * random_vector(n, 2);
    preconditioner = Jacobi(ComplexVector(diagonal(mass) + t * diagonal(stiffness)));
  }
  SolveReport solve(ComplexVector& x, const ConjugateGradientOptions& options = {}) const {
    x.setZero(b.size());
    ConjugateGradientWork<ComplexVector> work;
    return conjugate_gradient(matrix, preconditioner, b, x, nullptr, options, work);
  }
  SparseMatrix mass, stiffness;
  ComplexMatrix matrix;
  ComplexVector b;
  Jacobi<ComplexVector> preconditioner;
};

TEST(ComplexConjugateGradient, AgreesWithDenseElimination) {
  for (const Complex t : {Complex(0, 3), Complex(2, 50), Complex(-1, 0.5)}) {
    const System s(80, t);
    ComplexVector x;
    EXPECT_TRUE(s.solve(x, {.tolerance = 1e-13}).converged);
    const Eigen::MatrixXcd a = dense(s.mass) + t * dense(s.stiffness);
    const ComplexVector expected = a.partialPivLu().solve(s.b);
    EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm()) << t;
  }
}

TEST(ComplexConjugateGradient, TheResidualIsThatOfTheResult) {
  const System s(300, {0, 20});
  ComplexVector x, ax;
  const SolveReport report = s.solve(x, {.tolerance = 1e-5});
  apply(s.matrix, x, ax);
  EXPECT_NEAR((s.b - ax).norm() / s.b.norm(), report.residual, 1e-12);
  EXPECT_LE(report.residual, 1e-5);
}

TEST(ComplexConjugateGradient, ZeroAndInfiniteRightSides) {
  System s(20, {0, 1});
  s.b[3] = std::numeric_limits<double>::infinity();
  ComplexVector x;
  EXPECT_FALSE(s.solve(x).converged);
  s.b.setZero();
  EXPECT_TRUE(s.solve(x).converged);
  EXPECT_EQ(x.norm(), 0);
}

TEST(ComplexConjugateGradient, SameBitsForAnyNumberOfThreads) {
  const System s(50000, {0.3, 4});
  ComplexVector all, one;
  s.solve(all);
  const ThreadLimit limit(1);
  s.solve(one);
  EXPECT_EQ(all, one);
}

}  // namespace
}  // namespace pelage
