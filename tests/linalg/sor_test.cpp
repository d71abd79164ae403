#include "linalg/sor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"
#include "discretise/method.h"
#include "time/step_support.h"

namespace pelage {
namespace {

/// M + K(T) on a distorted closed sheet with a tensor that varies.
struct Problem {
  SharedMatrix mass, stiffness;
  SparseMatrix matrix;
  Vector right;
};

Problem elliptic(std::int32_t n) {
  Grid g;
  g.count = {n, n, 1};
  for (std::int32_t v = 0; v < n * n; ++v) {
    const double x = static_cast<double>(v % n) / (n - 1), y = static_cast<double>(v / n) / (n - 1);
    g.points.push_back({x + 0.3 * x * (1 - x) * y, y + 0.2 * std::sin(3 * x) * y * (1 - y), 0.3 * x * y});
  }
  const auto space = grid_method.make_node_space(g);
  std::vector<Tensor> tensors;
  for (const Point& p : space->geometry(SampleRule::quadrature, false).position)
    tensors.push_back({0.02 + 0.01 * std::sin(5 * p[1]), 0.004, 0, 0.01, 0.001, 0.01});
  Problem problem;
  problem.mass = space->sampled(SampleRule::vertices).mass;
  problem.stiffness = std::make_shared<const SparseMatrix>(space->stiffness(tensors));
  combine(1, *problem.mass, 1, *problem.stiffness, problem.matrix);
  problem.right.resize(n * n);
  for (Index i = 0; i < n * n; ++i) problem.right[i] = uniform(5, static_cast<std::uint64_t>(i)) - 0.5;
  return problem;
}

TEST(Sor, AgreesWithConjugateGradientsAndStepsOnAFittedGrid) {
  const Problem p = elliptic(30);
  const Vector expected = solve_spd(p.matrix, p.right, {.tolerance = 1e-14});
  StepMatrix step;
  step.update(p.mass, 1, p.stiffness, 1);
  Vector x = Vector::Zero(900);
  StepReport report;
  step.solve(p.right, x, nullptr, "u", 1e-14, report);
  EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm());
  for (const SweepColours& order : {SweepColours(*p.matrix.pattern), SweepColours::lexicographic(*p.matrix.pattern)}) {
    x.setZero();
    const SolveReport solved =
        successive_over_relaxation(p.matrix, order, p.right, x, nullptr, {.relaxation = 1.7, .tolerance = 1e-13});
    EXPECT_TRUE(solved.converged);
    EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm());
  }
}

TEST(Sor, ColoursAreNotLinked) {
  const Problem p = elliptic(9);
  const SweepColours colours(*p.matrix.pattern);
  EXPECT_EQ(colours.count(), 4U);
  std::vector<int> seen(81);
  for (std::size_t c = 0; c < colours.count(); ++c)
    for (const std::int32_t i : colours.rows(c)) {
      ++seen[static_cast<std::size_t>(i)];
      for (const std::int32_t j : colours.rows(c))
        if (i != j) {
          EXPECT_EQ(p.matrix.pattern->find(i, j), -1);
        }
    }
  EXPECT_EQ(std::ranges::count(seen, 1), 81);
}

/// The chain of three points has red and black ones.
TEST(Sor, ThreePointsHaveTwoColours) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = 6;
  for (std::int32_t i = 0; i < 6; ++i) {
    for (std::int32_t j = std::max(0, i - 1); j <= std::min(5, i + 1); ++j) pattern->column.push_back(j);
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  const SweepColours colours(*pattern);
  ASSERT_EQ(colours.count(), 2U);
  EXPECT_EQ(colours.rows(0), (std::vector<std::int32_t>{0, 2, 4}));
}

/// Young 1954: on a chain with both ends held the errors of Gauss and Seidel fall by cos^2 h in a sweep, with h = pi /
/// (n + 1), and those of the best relaxation, w = 2 / (1 + sin h), by w - 1 (times the number of sweeps, for a double
/// eigenvalue).
TEST(Sor, RelaxationMakesItAsMuchFasterAsTheorySays) {
  constexpr std::int32_t n = 31;
  auto pattern = std::make_shared<SparsePattern>();
  pattern->rows = pattern->columns = n;
  SparseMatrix a;
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = std::max(0, i - 1); j <= std::min(n - 1, i + 1); ++j) {
      pattern->column.push_back(j);
      a.value.push_back(i == j ? 2 : -1);
    }
    pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
  }
  a.pattern = pattern;
  const double h = std::numbers::pi / (n + 1), best = 2 / (1 + std::sin(h)), tolerance = 1e-10;
  const auto sweeps = [&](double relaxation) {
    Vector x = Vector::Zero(n);
    return successive_over_relaxation(a, SweepColours(*pattern), Vector::Ones(n), x, nullptr,
                                      {.relaxation = relaxation, .tolerance = tolerance})
        .iterations;
  };
  EXPECT_NEAR(sweeps(1), std::log(tolerance) / std::log(std::cos(h) * std::cos(h)), 0.05 * sweeps(1));
  EXPECT_GT(sweeps(best), std::log(tolerance) / std::log(best - 1));
  EXPECT_LT(sweeps(best), 1.5 * std::log(tolerance) / std::log(best - 1));
}

TEST(Sor, HeldUnknownsKeepTheirValues) {
  const Problem p = elliptic(12);
  Held held(144, 0);
  for (std::size_t i = 0; i < 12; ++i) held[i] = 1;
  Vector x = Vector::Zero(144), expected;
  for (Eigen::Index i = 0; i < 12; ++i) x[i] = 1 + 0.1 * static_cast<double>(i);
  expected = x;
  ConjugateGradientWork<Vector> work;
  conjugate_gradient(p.matrix, Jacobi(diagonal(p.matrix)), p.right, expected, &held, {.tolerance = 1e-13}, work);
  const SolveReport solved =
      successive_over_relaxation(p.matrix, SweepColours(*p.matrix.pattern), p.right, x, &held, {.tolerance = 1e-13});
  EXPECT_TRUE(solved.converged);
  EXPECT_EQ(x[3], 1.3);
  EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm());
}

TEST(Sor, SameBitsForAnyNumberOfThreads) {
  const Problem p = elliptic(100);
  const SweepColours colours(*p.matrix.pattern);
  Vector several = Vector::Zero(10000), one = several;
  successive_over_relaxation(p.matrix, colours, p.right, several, nullptr, {.max_iterations = 20});
  const ThreadLimit limit(1);
  successive_over_relaxation(p.matrix, colours, p.right, one, nullptr, {.max_iterations = 20});
  EXPECT_EQ((several - one).lpNorm<Eigen::Infinity>(), 0);
}

}  // namespace
}  // namespace pelage
