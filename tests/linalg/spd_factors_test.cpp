#include "linalg/spd_factors.h"

#include <gtest/gtest.h>

#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"

namespace pelage {
namespace {

/// -u'' + shift u on a line, with one pair of neighbours that is tied `tie` times as strongly as the others.
SparseMatrix line(std::int32_t n, double shift, double tie) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  std::vector<double> values;
  const auto weight = [&](std::int32_t i) { return i < 0 || i + 1 >= n ? 0.0 : i == n / 2 ? tie : 1.0; };
  for (std::int32_t i = 0; i < n; ++i) {
    if (i > 0) pattern->column.push_back(i - 1), values.push_back(-weight(i - 1));
    pattern->column.push_back(i), values.push_back(shift + weight(i - 1) + weight(i));
    if (i + 1 < n) pattern->column.push_back(i + 1), values.push_back(-weight(i));
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  return {pattern, values};
}

TEST(SpdFactors, SolveWhereConjugateGradientsAreSlow) {
  const std::int32_t n = 4000;
  const SparseMatrix a = line(n, 1e-7, 1e7);
  Vector x(n);
  for (std::int32_t i = 0; i < n; ++i) x[i] = std::sin(0.003 * i) + 0.2 * std::cos(0.7 * i);
  const Vector b = a * x, found = SpdFactors(a).solve(b);
  EXPECT_LT((a * found - b).norm(), 1e-10 * b.norm());
  EXPECT_THROW(solve_spd(a, b, {.tolerance = 1e-10, .max_iterations = 2000}), Error);
}

TEST(SpdFactors, AgreeWithConjugateGradients) {
  const SparseMatrix a = line(300, 0.1, 3);
  const Vector b = Vector::LinSpaced(300, -1, 2);
  EXPECT_LT((SpdFactors(a).solve(b) - solve_spd(a, b)).norm(), 1e-8 * b.norm());
  EXPECT_EQ(spd_inverse(std::make_shared<const SparseMatrix>(a))(b), SpdFactors(a).solve(b));
}

TEST(SpdFactors, RowsOfZerosAreLeftAlone) {
  SparseMatrix a = line(3, 0, 0);  // 0 - 1   2
  for (double& value : a.value) value = 0;
  const Vector b = Vector::LinSpaced(3, 1, 3);
  EXPECT_EQ(SpdFactors(a).solve(b), b);
}

}  // namespace
}  // namespace pelage
