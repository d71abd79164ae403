#include "linalg/sharpening.h"

#include <gtest/gtest.h>

#include "linalg/conjugate_gradient.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::dense;
using testing::random_vector;
using testing::sparse;

/// Cubic B-splines on a line: A has their values at the knots, M = A' W A, K is that of a chain.
struct Splines {
  explicit Splines(Eigen::Index n) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), k = a;
    for (Eigen::Index i = 0; i < n; ++i) {
      a(i, i) = 2.0 / 3;
      k(i, i) = 2;
      if (i > 0) a(i, i - 1) = a(i - 1, i) = 1.0 / 6;
      if (i > 0) k(i, i - 1) = k(i - 1, i) = -1;
    }
    const Vector w = random_vector(n, 1).array() + 1;
    mass = a.transpose() * w.asDiagonal() * a;
    stiffness = k;
    values = sparse(a);
    transposed = sparse(a.transpose());
  }
  Eigen::MatrixXd mass, stiffness;
  SparseMatrix values, transposed;
  VertexBasis basis() const { return {&values, &transposed}; }
};

TEST(Sharpening, TakesFewerIterationsToTheSameSolution) {
  const Splines s(400);
  const Eigen::MatrixXd system = s.mass + 0.02 * s.stiffness;
  const Vector d = system.diagonal(), b = random_vector(400, 2);
  const auto sharpening = make_sharpening(s.basis(), s.mass.diagonal(), d);
  ASSERT_TRUE(sharpening);
  Vector plain = Vector::Zero(400), sharp = plain;
  const SparseMatrix a = sparse(system);
  const SolveReport slow = ConjugateGradient().solve(a, d.cwiseInverse(), b, plain, {.tolerance = 1e-12});
  const SolveReport fast =
      ConjugateGradient().solve(a, d.cwiseInverse(), b, sharp, {.tolerance = 1e-12, .sharpening = &*sharpening});
  const Vector expected = system.llt().solve(b);
  EXPECT_LT((sharp - expected).norm(), 1e-10 * expected.norm());
  EXPECT_LT(fast.iterations, 0.7 * slow.iterations) << slow.iterations;
}

TEST(Sharpening, IsThePreconditionerThatItSays) {
  const Splines s(30);
  const Vector d = s.mass.diagonal(), r = random_vector(30, 3);
  const auto sharpening = make_sharpening(s.basis(), d, d);
  ASSERT_TRUE(sharpening);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(30, 30);
  const Eigen::MatrixXd p = one + sharpening->strength.asDiagonal() * (one - dense(s.values));
  const Vector expected = p * d.cwiseInverse().asDiagonal() * p.transpose() * r;
  Vector t, z;
  const double rz = sharpen(*sharpening, d.cwiseInverse(), r, t, z);
  EXPECT_LT((z - expected).norm(), 1e-14 * expected.norm());
  EXPECT_NEAR(rz, r.dot(expected), 1e-13 * std::abs(rz));
}

TEST(Sharpening, UnknownsWithoutPreconditionerAreHeld) {
  const Splines s(60);
  const auto sharpening = make_sharpening(s.basis(), s.mass.diagonal(), s.mass.diagonal());
  ASSERT_TRUE(sharpening);
  const Vector b = random_vector(60, 4), guess = random_vector(60, 5);
  Vector inverse_diagonal = s.mass.diagonal().cwiseInverse(), right = b;
  Eigen::MatrixXd system = s.mass;
  for (Eigen::Index i = 0; i < 60; i += 3) {  // the same by rows of the unit matrix
    inverse_diagonal[i] = 0;
    system.row(i).setZero();
    system(i, i) = 1;
    right[i] = guess[i];
  }
  Vector x = guess;
  const ConjugateGradientOptions options{.tolerance = 1e-13, .sharpening = &*sharpening};
  EXPECT_TRUE(ConjugateGradient().solve(sparse(s.mass), inverse_diagonal, b, x, options).converged);
  const Vector expected = system.partialPivLu().solve(right);
  EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm());
}

TEST(Sharpening, IsLeftOutWhereDiffusionPrevailsOrThereIsNoBasis) {
  const Splines s(30);
  const Vector m = s.mass.diagonal();
  EXPECT_FALSE(make_sharpening(s.basis(), m, 5 * m));
  EXPECT_FALSE(make_sharpening({}, m, m));
}

}  // namespace
}  // namespace pelage
