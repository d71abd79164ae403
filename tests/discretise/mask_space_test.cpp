// The masks of Witkin and Kass.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "discretise/method.h"
#include "pelage/error.h"

namespace pelage {
namespace {

using std::numbers::pi;

Grid sheet(std::int32_t n, bool periodic) {
  Grid g;
  g.count = {n, n, 1};
  g.periodic = {periodic, periodic, false};
  g.spacing = {1.0 / (periodic ? n : n - 1), 1.0 / (periodic ? n : n - 1), 1};
  return g;
}

/// Row by row from below to above, as the paper prints it from above to below: 1 / (2 h^2) times
/// (-a12, 2 a22, a12; 2 a11, -4 (a11 + a22), 2 a11; a12, 2 a22, -a12).
TEST(MaskSpace, IsTheMaskOfThePaper) {
  Grid g = sheet(5, true);
  g.spacing = {0.5, 0.5, 1};
  const auto space = mask_method.make_node_space(g);
  const double a11 = 3, a12 = 0.5, a22 = 1, h = 0.5;
  const SparseMatrix k = space->stiffness(std::vector<Tensor>(25, {a11, a12, 0, a22, 0, 0}));
  const SharedMatrix mass = space->sampled(SampleRule::vertices).mass;
  const std::array<std::array<double, 3>, 3> mask = {
      {{a12, 2 * a22, -a12}, {2 * a11, -4 * (a11 + a22), 2 * a11}, {-a12, 2 * a22, a12}}};
  const Index middle = 12;
  EXPECT_EQ(diagonal(*mass)[middle], h * h);
  for (Index dy = -1; dy <= 1; ++dy)
    for (Index dx = -1; dx <= 1; ++dx) {
      const auto e = static_cast<std::size_t>(k.pattern->find(middle, middle + dx + 5 * dy));
      EXPECT_DOUBLE_EQ(-k.value[e] / (h * h),
                       mask[static_cast<std::size_t>(dy + 1)][static_cast<std::size_t>(dx + 1)] / (2 * h * h));
    }
}

/// Of A_ij d_i d_j u with A that varies, relative to the largest value.
double worst_error(std::int32_t n, bool periodic) {
  const auto space = mask_method.make_node_space(sheet(n, periodic));
  std::vector<Tensor> a;
  Vector u(space->unknowns()), expected = u;
  for (Index v = 0; v < space->unknowns(); ++v) {
    const auto [x, y, z] = space->control()[static_cast<std::size_t>(v)];
    const double a11 = 2 + std::sin(2 * pi * y), a12 = 0.5 * std::cos(2 * pi * x),
                 a22 = 1.5 + 0.3 * std::cos(2 * pi * y);
    a.push_back({a11, a12, 0, a22, 0, 0});
    u[v] = std::cos(2 * pi * x) * std::cos(4 * pi * y);  // even about all borders
    expected[v] = -a11 * 4 * pi * pi * u[v] - a22 * 16 * pi * pi * u[v] +
                  2 * a12 * 8 * pi * pi * std::sin(2 * pi * x) * std::sin(4 * pi * y);
  }
  const Vector rate = -(space->stiffness(a) * u).cwiseQuotient(diagonal(*space->sampled(SampleRule::vertices).mass));
  return (rate - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

TEST(MaskSpace, DifferencesAreOfSecondOrderAndBordersAreMirrors) {
  EXPECT_NEAR(std::log2(worst_error(32, true) / worst_error(64, true)), 2, 0.1);
  EXPECT_NEAR(std::log2(worst_error(33, false) / worst_error(65, false)), 2, 0.1);
  EXPECT_LT(worst_error(65, false), 0.02);
}

TEST(MaskSpace, AConstantHasNoFluxAndTheMassIsTheArea) {
  const auto space = mask_method.make_node_space(sheet(9, false));
  const Vector ones = Vector::Ones(space->unknowns());
  EXPECT_LT((*space->stiffness() * ones).lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_NEAR(sum(*space->sampled(SampleRule::vertices).mass * ones), 1, 1e-14);
}

TEST(MaskSpace, GradientsAreCentralDifferences) {
  const auto space = mask_method.make_node_space(sheet(64, true));
  Vector u(space->unknowns()), expected = u;
  for (Index v = 0; v < space->unknowns(); ++v) {
    const auto [x, y, z] = space->control()[static_cast<std::size_t>(v)];
    u[v] = std::sin(2 * pi * (x + y));
    expected[v] = 8 * pi * pi * std::pow(std::cos(2 * pi * (x + y)), 2);
  }
  EXPECT_LT((space->gradient_product(SampleRule::vertices, u, u) - expected).lpNorm<Eigen::Infinity>(), 0.01 * 80);
}

TEST(MaskSpace, OtherGridsAreRefused) {
  Grid block = sheet(5, false);
  block.count[2] = 3;
  EXPECT_THROW(mask_method.make_node_space(block), Error);
  Grid line = sheet(5, false);
  line.count[1] = 1;
  EXPECT_THROW(mask_method.make_node_space(line), Error);
}

/// A sheet of parallelograms in space, a and b along their sides; between nodes nothing but the metric is left.
Grid oblique(std::int32_t n, const Point& a, const Point& b) {
  Grid grid = sheet(n, true);
  for (std::int32_t v = 0; v < n * n; ++v) {
    Point p{};
    for (std::size_t d = 0; d < 3; ++d) p[d] = a[d] * (v % n) + b[d] * (v / n);
    grid.points.push_back(p);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    grid.period[0][d] = n * a[d];
    grid.period[1][d] = n * b[d];
  }
  return grid;
}

/// A = I becomes the inverse of the metric: the weights of the mask are its entries.
TEST(MaskSpace, OnASurfaceTheUnitTensorBecomesTheInverseOfTheMetric) {
  const Point a{1, 0.2, 0.3}, b{-0.4, 2, 0.1};
  const auto space = mask_method.make_node_space(oblique(6, a, b));
  Eigen::Matrix<double, 3, 2> jacobian;
  for (Eigen::Index d = 0; d < 3; ++d)
    jacobian.row(d) << a[static_cast<std::size_t>(d)], b[static_cast<std::size_t>(d)];
  const Eigen::Matrix2d metric = jacobian.transpose() * jacobian, inverse = metric.inverse();
  const double area = std::sqrt(metric.determinant());
  const SparseMatrix& k = *space->stiffness();
  const auto entry = [&](Index column) {
    return k.value[static_cast<std::size_t>(k.pattern->find(14, column))] / area;
  };
  EXPECT_NEAR(entry(15), -inverse(0, 0), 1e-12);
  EXPECT_NEAR(entry(20), -inverse(1, 1), 1e-12);
  EXPECT_NEAR(entry(21), -inverse(0, 1) / 2, 1e-12);
  EXPECT_NEAR(entry(19), inverse(0, 1) / 2, 1e-12);
  EXPECT_NEAR(entry(14), 2 * inverse.trace(), 1e-12);
}

}  // namespace
}  // namespace pelage
