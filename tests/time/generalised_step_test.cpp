#include "time/generalised_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pelage/error.h"
#include "shape/generators.h"

namespace pelage {
namespace {

struct Sphere {
  TriangleMesh mesh = builtin_shape("builtin:sphere?n=642");
  Discretisation discretisation = loop_discretisation(make_topology(mesh.points.size(), mesh.triangles));
  std::vector<Point> control = interpolating_control(discretisation, mesh.points);
  Assembler assembler{discretisation};
  Sampling sampling = quadrature_sampling(discretisation, control);

  Eigen::MatrixXd positions() const {
    Eigen::MatrixXd x(static_cast<Eigen::Index>(control.size()), 3);
    for (std::size_t i = 0; i < control.size(); ++i)
      for (int k = 0; k < 3; ++k) x(static_cast<Eigen::Index>(i), k) = control[i][static_cast<std::size_t>(k)];
    return x;
  }
  StepReport step(const GeneralisedPde& pde, double dt, Eigen::MatrixXd& u) const {
    return generalised_step(assembler, control, sampling, pde, dt, u, 1e-12);
  }
};

/// Coordinates are spherical harmonics of degree 1: an implicit step of the heat equation divides them by 1 + 2 dt.
TEST(GeneralisedStep, VectorValuedDiffusionShrinksTheSphere) {
  const Sphere s;
  Eigen::MatrixXd x = s.positions();
  const Eigen::MatrixXd before = x;
  ASSERT_TRUE(s.step({}, 0.1, x).accepted);
  EXPECT_LT((x * 1.2 - before).norm() / before.norm(), 1e-4);
}

TEST(GeneralisedStep, SourceAndDecayAtAUniformStateAreThoseOfTheOde) {
  const Sphere s;
  const auto points = static_cast<std::size_t>(s.sampling.count());
  GeneralisedPde pde;
  pde.c2.assign(points, -3.0);
  pde.c3 = Eigen::MatrixXd::Constant(s.sampling.count(), 1, 5.0);
  Eigen::MatrixXd u = Eigen::MatrixXd::Constant(642, 1, 2.0);
  ASSERT_TRUE(s.step(pde, 0.1, u).accepted);
  EXPECT_LT((u.array() - (2 + 0.1 * 5) / (1 + 0.1 * 3)).abs().maxCoeff(), 1e-9);
}

/// C0 stands before all that happens in space, and there is nothing of that.
TEST(GeneralisedStep, AVaryingC0ChangesNoUniformState) {
  const Sphere s;
  GeneralisedPde pde;
  for (const Point& p : s.sampling.position) pde.c0.push_back(2 + p[0]);
  pde.c2.assign(pde.c0.size(), -3.0);
  pde.c3 = Eigen::MatrixXd::Constant(s.sampling.count(), 1, 5.0);
  Eigen::MatrixXd u = Eigen::MatrixXd::Constant(642, 1, 2.0);
  ASSERT_TRUE(s.step(pde, 0.1, u).accepted);
  EXPECT_LT((u.array() - (2 + 0.1 * 5) / (1 + 0.1 * 3)).abs().maxCoeff(), 1e-9);
}

TEST(GeneralisedStep, ConstantC0OfZeroStopsDiffusion) {
  const Sphere s;
  GeneralisedPde pde;
  pde.c0_constant = 0;
  Eigen::MatrixXd x = s.positions();
  const Eigen::MatrixXd before = x;
  ASSERT_TRUE(s.step(pde, 10, x).accepted);
  EXPECT_LT((x - before).norm(), 1e-9);
}

/// d/dt of the integral of u / C0 is that of div grad u: nothing.
TEST(GeneralisedStep, VaryingC0ConservesItsWeightedIntegral) {
  const Sphere s;
  GeneralisedPde pde;
  for (const Point& p : s.sampling.position) pde.c0.push_back(2 + p[0]);
  Eigen::MatrixXd x = s.positions();
  auto integral = [&](const Eigen::MatrixXd& u) {
    const Vector value = s.sampling.values * Vector(u.col(0));
    double sum = 0;
    for (Eigen::Index q = 0; q < value.size(); ++q)
      sum += s.sampling.weight[q] * value[q] / pde.c0[static_cast<std::size_t>(q)];
    return sum;
  };
  const double before = integral(x);
  ASSERT_TRUE(s.step(pde, 0.5, x).accepted);
  EXPECT_NEAR(integral(x), before, 1e-9);
  EXPECT_GT(std::abs(before), 0.1);
}

TEST(GeneralisedStep, TensorOfTheIdentityIsTheScalar) {
  const Sphere s;
  GeneralisedPde tensor;
  tensor.c1_tensor.assign(s.sampling.position.size(), Tensor{2, 0, 0, 2, 0, 2});
  GeneralisedPde scalar;
  scalar.c1.assign(s.sampling.position.size(), 2.0);
  Eigen::MatrixXd x = s.positions(), y = x;
  ASSERT_TRUE(s.step(tensor, 0.3, x).accepted && s.step(scalar, 0.3, y).accepted);
  EXPECT_LT((x - y).norm(), 1e-9);
}

TEST(GeneralisedStep, FaultsAreTold) {
  const Sphere s;
  GeneralisedPde zero;
  zero.c0.assign(s.sampling.position.size(), 0.0);
  Eigen::MatrixXd x = s.positions();
  const Eigen::MatrixXd before = x;
  EXPECT_THROW(s.step(zero, 0.1, x), Error);
  EXPECT_EQ(x, before);
}

/// (1 - dt C2 + 2 dt) x' = x with C2 = 6 and dt = 1; the factor of harmonics of degree l is l (l + 1) - 5.
TEST(GeneralisedStep, IndefiniteMatricesAreSolvedWith) {
  const Sphere s;
  GeneralisedPde growing;
  growing.c2.assign(s.sampling.position.size(), 6.0);
  Eigen::MatrixXd x = s.positions();
  const Eigen::MatrixXd before = x;
  const StepReport report = s.step(growing, 1, x);
  ASSERT_TRUE(report.accepted) << report.failure;
  EXPECT_EQ(report.indefinite, 3);
  EXPECT_LT((x * -3 - before).norm() / before.norm(), 1e-3);
}

}  // namespace
}  // namespace pelage
