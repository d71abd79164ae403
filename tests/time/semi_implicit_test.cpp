// Semi-implicit Euler where its matrices are kept for some steps, and where they are not positive definite.

#include <gtest/gtest.h>

#include <cmath>

#include "base/dense.h"
#include "discretise/method.h"
#include "shape/generators.h"
#include "support/random_matrices.h"
#include "support/space_system.h"

namespace pelage {
namespace {

constexpr double speed = 0.05;  // s of the Turing system

std::shared_ptr<const Space> sphere() {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=100");
  return loop_method.make_space(std::make_shared<const Topology>(make_topology(mesh.points.size(), mesh.triangles)),
                                mesh.points);
}

/// Eqs. (12)-(13) of Bajaj, Zhang, Xu 2008, from a start that differs from place to place by `unevenness`.
struct Turing : SpaceSystem {
  explicit Turing(double unevenness) : SpaceSystem(sphere(), SampleRule::quadrature) {
    add_species(0.125, [=](const Point& p) { return 4 + unevenness * p[0]; });
    add_species(0.03125, [=](const Point& p) { return 4 + unevenness * p[1]; });
    set_reaction(system, [](const std::vector<double>& u, double, std::vector<double>& c2, std::vector<double>& c3) {
      c2 = {-speed * u[1], speed * (u[0] - 1)};
      c3 = {speed * 16, -speed * 12};
    });
  }
};

/// b is made where a is above 1 + 1/(s dt): where a is 4 that is so from dt = 1/(3 s) on.
TEST(SemiImplicit, IndefiniteMatricesAreSolvedWith) {
  Turing s(3);
  const double dt = 0.4 / speed;
  const Vector a = s.space->sampled(SampleRule::quadrature).sampling->values * s.state.now[0];
  const Eigen::MatrixXd mass = testing::dense(*s.system.mass),
                        made = testing::dense(s.system.weighted_mass(speed * (a.array() - 1).matrix())),
                        matrix = mass - dt * made + dt * 0.03125 * testing::dense(*s.space->stiffness());
  const Vector source = load(*s.system.sampling, Vector::Constant(s.system.sampling->count(), -speed * 12));
  const Vector expected = solved(matrix, mass * s.state.now[1] + dt * source);
  const Vector values = symmetric_modes(matrix).values;
  ASSERT_TRUE(values.minCoeff() < 0 && values.maxCoeff() > 0);
  const StepReport report = semi_implicit.make()->step(s.system, s.state, {.dt = dt, .solver_tolerance = 1e-12});
  ASSERT_TRUE(report.accepted) << report.failure;
  EXPECT_EQ(report.indefinite, 1);
  EXPECT_LT((s.state.now[1] - expected).norm(), 1e-8 * expected.norm());
}

/// Where nothing differs from place to place: (1 - dt C2) u' = u + dt (C3(u) + (C2(u) - C2) u), with the C2 of the
/// latest step whose number is a multiple of the interval.
TEST(SemiImplicit, KeptMatricesHaveAnEarlierC2) {
  Turing s(0);
  double u[] = {5, 3}, kept[2] = {};
  for (std::size_t i : {0, 1}) s.state.now[i].setConstant(u[i]);
  const double dt = 0.02 / speed;
  const auto stepper = semi_implicit.make();
  for (int k = 0; k < 8; ++k) {
    const double c2[] = {-speed * u[1], speed * (u[0] - 1)}, c3[] = {speed * 16, -speed * 12};
    for (std::size_t i : {0, 1}) {
      if (k % 3 == 0) kept[i] = c2[i];
      u[i] = (u[i] + dt * (c3[i] + (c2[i] - kept[i]) * u[i])) / (1 - dt * kept[i]);
    }
    const StepRequest request{.dt = dt, .solver_tolerance = 1e-13, .refresh = 3};
    ASSERT_TRUE(stepper->step(s.system, s.state, request).accepted);
    for (std::size_t i : {0, 1}) EXPECT_LT((s.state.now[i].array() - u[i]).abs().maxCoeff(), 1e-9) << k;
  }
}

/// Another stepper that goes on makes the same matrices, since the state knows what they were made of.
TEST(SemiImplicit, KeptMatricesAreFoundAgain) {
  Turing one(0.5), other(0.5);
  const StepRequest request{.dt = 0.02 / speed, .refresh = 5};
  const auto throughout = semi_implicit.make();
  for (int k = 0; k < 8; ++k) {
    throughout->step(one.system, one.state, request);
    semi_implicit.make()->step(other.system, other.state, request);
  }
  for (std::size_t i : {0, 1}) EXPECT_EQ(one.state.now[i], other.state.now[i]);
}

}  // namespace
}  // namespace pelage
