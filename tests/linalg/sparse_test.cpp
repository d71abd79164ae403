#include "linalg/sparse.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using testing::dense;
using testing::random_matrix;
using testing::random_vector;

TEST(Sparse, ApplyIsTheDenseProduct) {
  const SparseMatrix a = random_matrix(61, 47, 7, 1);
  const Vector x = random_vector(47, 2);
  EXPECT_LT((a * x - dense(a) * x).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Sparse, TransposeIsTheDenseTransposeWithAscendingColumns) {
  const SparseMatrix a = random_matrix(61, 47, 7, 3);
  const SparseMatrix t = transpose(a);
  EXPECT_EQ(dense(t), dense(a).transpose());
  for (std::int32_t r = 0; r < t.rows(); ++r)
    for (auto k = t.pattern->start[r] + 1; k < t.pattern->start[r + 1]; ++k)
      EXPECT_LT(t.pattern->column[k - 1], t.pattern->column[k]);
}

TEST(Sparse, CombineAddsInPlaceToo) {
  SparseMatrix a = random_matrix(30, 30, 5, 4);
  SparseMatrix b = a;
  for (double& v : b.value) v = v * v + 1;
  const Eigen::MatrixXd expected = 2 * dense(a) - 3 * dense(b);
  combine(2, a, -3, b, a);
  EXPECT_LT((dense(a) - expected).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Sparse, FindAndDiagonal) {
  const SparseMatrix a = random_matrix(40, 40, 6, 5);
  const Eigen::MatrixXd d = dense(a);
  const Vector on_diagonal = diagonal(a);
  for (std::int32_t r = 0; r < 40; ++r) {
    EXPECT_EQ(on_diagonal[r], d(r, r));
    for (std::int32_t c = 0; c < 40; ++c) {
      const auto k = a.pattern->find(r, c);
      EXPECT_EQ(k < 0 ? 0 : a.value[static_cast<std::size_t>(k)], d(r, c));
    }
  }
}

TEST(Sparse, DotAndAxpby) {
  const Vector x = random_vector(10001, 6);
  Vector y = random_vector(10001, 7);
  EXPECT_NEAR(dot(x, y), x.dot(y), 1e-12);
  const Vector expected = 2 * x + 0.25 * y;
  axpby(2, x, 0.25, y);
  EXPECT_LT((y - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Sparse, SumsDoNotDependOnTheNumberOfThreads) {
  const Vector x = random_vector(100001, 8), y = random_vector(100001, 9);
  const double all = dot(x, y);
  const ThreadLimit one(1);
  EXPECT_EQ(dot(x, y), all);
}

}  // namespace
}  // namespace pelage
