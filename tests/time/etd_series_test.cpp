// Exponential time differencing on spaces with matrices. What it does by waves is in lattice_stepper_test.cpp.

#include "time/etd_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "base/parallel.h"
#include "discretise/method.h"
#include "shape/generators.h"
#include "shape/topology.h"
#include "support/lattice_system.h"
#include "support/random_matrices.h"
#include "support/space_system.h"
#include "support/steppers.h"

namespace pelage {
namespace {

using testing::dense;

using std::numbers::pi;

std::shared_ptr<const Space> sphere(const Method& method, int vertices) {
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=" + std::to_string(vertices));
  return method.make_space(std::make_shared<const Topology>(make_topology(mesh.points.size(), mesh.triangles)),
                           mesh.points);
}

double uneven(const Point& p) { return 1 + 0.4 * p[0] - 0.3 * p[1] * p[2] + 0.2 * std::sin(5 * p[2]); }

/// The operator of time/diffusion_operator.h, written down a second time: one term of the series of the mass.
Eigen::MatrixXd dense_diffusion(const SpaceSystem& s, double diffusion) {
  const Eigen::MatrixXd mass = dense(*s.system.mass), stiffness = dense(*s.space->stiffness());
  const Eigen::MatrixXd over_sums = mass.rowwise().sum().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(mass.rows(), mass.cols());
  return diffusion * (one + (one - over_sums * mass)) * over_sums * stiffness;
}

/// By scaling and squaring of the power series.
Eigen::MatrixXd dense_exponential(const Eigen::MatrixXd& a) {
  const int squarings =
      4 + std::max(0, static_cast<int>(std::ceil(std::log2(a.cwiseAbs().rowwise().sum().maxCoeff()))));
  const Eigen::MatrixXd small = a / std::pow(2.0, squarings);
  Eigen::MatrixXd term = Eigen::MatrixXd::Identity(a.rows(), a.cols()), sum = term;
  for (int k = 1; k < 14; ++k) {
    term = (term * small / k).eval();
    sum += term;
  }
  for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
  return sum;
}

void advance_series(SpaceSystem& s, Stepper& stepper, int steps, double time) {
  for (int k = 0; k < steps; ++k) {
    const StepReport report = stepper.step(s.system, s.state, {.dt = time / steps, .solver_tolerance = 1e-13});
    ASSERT_TRUE(report.accepted) << report.failure;
  }
}

/// Diffusion and a constant decay alone: one step of any length is the exponential of the matrix.
TEST(EtdSeries, TheLinearPartIsTheMatrixExponential) {
  SpaceSystem s(sphere(linear_method, 162));
  s.add_species(0.05, uneven);
  set_reaction(s.system, [](auto&&, double, std::vector<double>& c2, auto&&) { c2[0] = -0.3; });
  const double time = 2;
  const Eigen::MatrixXd whole =
      dense_exponential(-time * (dense_diffusion(s, 0.05) + 0.3 * Eigen::MatrixXd::Identity(162, 162)));
  const Vector expected = whole * s.state.now[0];
  advance_series(s, *etd.make(), 1, time);
  EXPECT_LT((s.state.now[0] - expected).norm(), 1e-11 * expected.norm());
}

/// u' = -B u - 0.5 u + 2 v, v' = -B v / 4 - u: a linear system of both, of which the scheme takes 2 v and -u
/// explicitly. Against the exponential of its matrix.
TEST(EtdSeries, IsOfThirdOrderAgainstTheMatrixExponential) {
  const auto error = [](int steps) {
    SpaceSystem s(sphere(linear_method, 100));
    s.add_species(0.05, uneven);
    s.add_species(0.0125, [](const Point& p) { return p[0] * p[1]; });
    set_reaction(s.system, [](const std::vector<double>& u, double, std::vector<double>& c2, std::vector<double>& c3) {
      c2 = {-0.5, 0};
      c3 = {2 * u[1], -u[0]};
    });
    const auto n = s.state.now[0].size();
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd whole(2 * n, 2 * n);
    whole << -dense_diffusion(s, 0.05) - 0.5 * one, 2 * one, -one, -dense_diffusion(s, 0.0125);
    Vector start(2 * n), end(2 * n);
    start << s.state.now[0], s.state.now[1];
    const Vector expected = dense_exponential(2 * whole) * start;
    advance_series(s, *etd.make(), steps, 2);
    end << s.state.now[0], s.state.now[1];
    return (end - expected).norm() / expected.norm();
  };
  const double coarse = error(8), fine = error(16);
  EXPECT_NEAR(std::log2(coarse / fine), 3, 0.15);
  EXPECT_LT(fine, 1e-3);
}

void fitzhugh_nagumo(const std::vector<double>& u, double t, std::vector<double>& c2, std::vector<double>& c3) {
  c2 = {1 - u[0] * u[0], -0.5};
  c3 = {-u[1] + 0.1 * std::sin(3 * t), u[0] / 2};
}

/// Every method of surfaces: where coefficients are values, and where they are not.
TEST(EtdSeries, IsOfThirdOrderOnEverySurface) {
  for (const Method* method : {&linear_method, &loop_method}) {
    std::vector<Vector> end;
    for (int parts : {1, 2, 4}) {
      SpaceSystem s(sphere(*method, 100));
      s.add_species(0.01, uneven);
      s.add_species(0, [](const Point& p) { return 0.5 * p[2]; });
      set_reaction(s.system, fitzhugh_nagumo);
      advance_series(s, *etd.make(), 16 * parts, 2);
      end.push_back(s.state.now[0]);
    }
    EXPECT_NEAR(std::log2((end[0] - end[1]).norm() / (end[1] - end[2]).norm()), 3, 0.2) << method->name;
  }
}

/// On an even periodic grid what differs from the exact decay of waves is the error of the elements, of fourth order.
TEST(EtdSeries, AgreesWithWavesOnAnEvenGrid) {
  const auto difference = [](std::size_t n) {
    const auto count = static_cast<std::int32_t>(n);
    Grid grid;
    grid.count = {count, count, 1};
    grid.periodic = {true, true, false};
    grid.spacing = {2 * pi / count, 2 * pi / count, 1};
    const auto start = [](double x, double y) { return std::sin(x) + 0.3 * std::cos(2 * y) + 0.1; };
    SpaceSystem matrices(grid_method.make_node_space(grid));
    LatticeSystem waves({{n, n, 1}, {true, true, false}, {grid.spacing[0], grid.spacing[1], 1}});
    for (const double diffusion : {0.3, 0.0}) {
      matrices.add_species(diffusion, [&](const Point& p) { return start(p[0], p[1]); });
      waves.add_species(diffusion * Eigen::Matrix3d::Identity(), [&](std::size_t i, std::size_t j, std::size_t) {
        return start(grid.spacing[0] * static_cast<double>(i), grid.spacing[1] * static_cast<double>(j));
      });
    }
    set_reaction(matrices.system, fitzhugh_nagumo);
    waves.set_reaction(fitzhugh_nagumo);
    const auto first = etd.make(), second = etd.make();
    for (int k = 0; k < 20; ++k) {
      EXPECT_TRUE(first->step(matrices.system, matrices.state, {.dt = 0.1, .solver_tolerance = 1e-12}).accepted);
      EXPECT_TRUE(second->step(waves.system, waves.state, {.dt = 0.1}).accepted);
    }
    return (matrices.state.now[0] - waves.state.now[0]).norm() / waves.state.now[0].norm();
  };
  const double coarse = difference(32), fine = difference(64);
  EXPECT_LT(fine, 5e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2);
}

TEST(EtdSeries, HeldUnknownsStayAndDriveTheOthers) {
  std::vector<Vector> end;
  for (const StepperKind* stepper : {&etd, &sbdf2}) {
    SpaceSystem s(sphere(linear_method, 162));
    s.add_species(0.3, uneven);
    auto held = std::make_shared<Held>(162, 0);
    for (std::size_t v = 0; v < 162; ++v) (*held)[v] = s.space->control()[v][2] > 0.5;
    s.system.held = held;
    set_reaction(s.system, [](auto&&, double t, std::vector<double>& c2, std::vector<double>& c3) {
      c2[0] = -1;
      c3[0] = std::sin(3 * t);  // other rates in each stage
    });
    const Vector before = s.state.now[0];
    advance_series(s, *stepper->make(), stepper == &etd ? 10 : 500, 1);
    for (Eigen::Index v = 0; v < 162; ++v)
      if ((*held)[static_cast<std::size_t>(v)]) {
        EXPECT_EQ(s.state.now[0][v], before[v]) << stepper->name;
      }
    end.push_back(s.state.now[0]);
  }
  // The mass is inverted by one term of its series.
  EXPECT_LT((end[0] - end[1]).norm(), 2e-3 * end[1].norm());
}

/// As for waves: the estimate is the error of the scheme of second order inside.
TEST(EtdSeries, EstimatesTheErrorOfAStepAndRejects) {
  const auto step = [](double dt, double largest, State* after = nullptr) {
    SpaceSystem s(sphere(linear_method, 162));
    s.add_species(0.05, uneven);
    s.add_species(0, [](const Point& p) { return p[0]; });
    set_reaction(s.system, fitzhugh_nagumo);
    const StepReport report =
        etd.make()->step(s.system, s.state, {.dt = dt, .largest_error = largest, .solver_tolerance = 1e-12});
    if (after) *after = s.state;
    return report;
  };
  EXPECT_NEAR(std::log2(step(0.02, 1).error / step(0.01, 1).error), 3, 0.1);
  State after;
  const StepReport report = step(1, 1e-9, &after);
  EXPECT_FALSE(report.accepted);
  EXPECT_TRUE(report.failure.empty());
  EXPECT_EQ(after.step, 0);
}

TEST(EtdSeries, LongerStepsTakeMoreProductsAsTheRootGrows) {
  const auto products = [](double dt) {
    SpaceSystem s(sphere(linear_method, 642));
    s.add_species(1, uneven);
    return etd.make()->step(s.system, s.state, {.dt = dt, .solver_tolerance = 1e-8}).iterations;
  };
  EXPECT_NEAR(products(4) / static_cast<double>(products(1)), 2, 0.4);
}

TEST(EtdSeries, SameBitsForAnyNumberOfThreads) {
  const auto run = [] {
    SpaceSystem s(sphere(linear_method, 5000));
    s.add_species(0.05, uneven);
    s.add_species(0, [](const Point& p) { return p[0]; });
    set_reaction(s.system, fitzhugh_nagumo);
    const auto stepper = etd.make();
    for (int k = 0; k < 3; ++k) stepper->step(s.system, s.state, {.dt = 0.1, .solver_tolerance = 1e-6});
    return s.state.now[0];
  };
  const Vector several = run();
  const ThreadLimit limit(1);
  EXPECT_EQ((run() - several).cwiseAbs().maxCoeff(), 0);
}

TEST(EtdSeries, RefusesWhatItCannotDo) {
  SpaceSystem s(sphere(linear_method, 100));
  s.add_species(0.05, uneven);
  s.system.species[0].algebraic = true;
  const StepReport report = etd.make()->step(s.system, s.state, {.dt = 0.1});
  EXPECT_TRUE(report.refused);
  EXPECT_NE(report.failure.find("at once"), std::string::npos);
}

}  // namespace
}  // namespace pelage
