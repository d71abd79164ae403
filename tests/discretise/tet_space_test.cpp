// Linear elements on tetrahedra: identities, and the eigenvalues of a ball from another derivation.

#include "discretise/tet_space.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "shape/generators.h"
#include "shape/tet_mesh.h"
#include "shape/tet_quality.h"
#include "shape/vectors.h"
#include "solid/fill.h"
#include "support/random_matrices.h"

namespace pelage {
namespace {

using std::numbers::pi;
using testing::dense;
using testing::random_vector;

TetMesh ball(double edge) { return fill(builtin_shape("builtin:sphere?n=20000"), edge, 4'000'000).volume; }

Vector values(const Space& space, const std::function<double(const Point&)>& f) {
  Vector u(space.unknowns());
  for (Index v = 0; v < space.unknowns(); ++v) u[v] = f(space.control()[static_cast<std::size_t>(v)]);
  return u;
}

std::size_t points_of(const Space& s) {
  return static_cast<std::size_t>(s.sampled(SampleRule::quadrature).sampling->count());
}

TEST(TetSpace, LinearFunctionsHaveTheirEnergyAndNoResidualInside) {
  const TetMesh mesh = ball(0.35);
  const TetSpace space(mesh);
  const double volume = volume_of(mesh);
  const Tensor tensor = {2, -0.7, 0.3, 1, 0.2, 1.5};
  const SparseMatrix k = space.stiffness(std::vector<Tensor>(points_of(space), tensor));
  std::vector<char> skin(mesh.nodes(), 0);
  for (const Index v : space.border("skin").node) skin[static_cast<std::size_t>(v)] = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const Vector u = values(space, [a](const Point& p) { return p[a]; });
    const Vector ku = k * u;
    for (Index v = 0; v < space.unknowns(); ++v)
      if (!skin[static_cast<std::size_t>(v)]) {
        EXPECT_NEAR(ku[v], 0, 1e-12);
      }
    for (std::size_t b = 0; b < 3; ++b) {
      const Vector w = values(space, [b](const Point& p) { return p[b]; });
      EXPECT_NEAR(w.dot(ku), volume * matrix_of(tensor)(static_cast<int>(a), static_cast<int>(b)), 1e-11);
      for (const SampleRule rule : {SampleRule::vertices, SampleRule::quadrature}) {
        const Vector product = space.gradient_product(rule, u, w);
        EXPECT_LT((product.array() - (a == b ? 1.0 : 0.0)).abs().maxCoeff(), 1e-11);
      }
    }
  }
}

TEST(TetSpace, MatricesAreSymmetricAndRulesAgree) {
  const TetMesh mesh = ball(0.5);
  const TetSpace space(mesh);
  const Vector ones = Vector::Ones(space.unknowns());
  const Vector u = random_vector(space.unknowns(), 5), w = random_vector(space.unknowns(), 6);
  const std::vector<double> one(points_of(space), 1.0);
  const std::vector<Tensor> identity(points_of(space), Tensor{1, 0, 0, 1, 0, 1});
  const SampledMass at_points = space.sampled(SampleRule::quadrature);
  EXPECT_LT((dense(*space.stiffness()) - dense(space.stiffness(one))).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((dense(*space.stiffness()) - dense(space.stiffness(identity))).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((dense(*at_points.mass) - dense(space.weighted_mass(one))).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((*space.stiffness() * ones).lpNorm<Eigen::Infinity>(), 1e-12);
  for (const SampleRule rule : {SampleRule::vertices, SampleRule::quadrature}) {
    const SampledMass sampled = space.sampled(rule);
    const Eigen::MatrixXd m = dense(*sampled.mass);
    EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-14);
    const Vector samples = sampled.sampling->values * u;
    EXPECT_LT((load(*sampled.sampling, samples) - *sampled.mass * u).norm(), 1e-12);  // M = test W values
  }
  // Four points see squares as they are.
  const Vector product = (at_points.sampling->values * u).cwiseProduct(at_points.sampling->values * w);
  EXPECT_NEAR(at_points.sampling->weight.dot(product), w.dot(*at_points.mass * u), 1e-12);
  // Products of gradients likewise.
  EXPECT_NEAR(at_points.sampling->weight.dot(space.gradient_product(SampleRule::quadrature, u, w)),
              w.dot(*space.stiffness() * u), 1e-10);
}

TEST(TetSpace, TheSkinIsTheSphereAndItsNormalsPointOut) {
  const TetSpace space(ball(0.1));
  const SpaceBorder skin = space.border("skin");
  const PlaceGeometry places = space.geometry(SampleRule::vertices, true);
  std::vector<char> on_skin(places.position.size(), 0);
  for (std::size_t k = 0; k < skin.node.size(); ++k) {
    const auto v = static_cast<std::size_t>(skin.node[k]);
    on_skin[v] = 1;
    EXPECT_NEAR(length(places.position[v]), 1, 1e-3);
    EXPECT_GT(dot(places.normal[v], places.position[v]), 0.97);
  }
  EXPECT_NEAR(sum(skin.mass * Vector(Vector::Ones(skin.mass.columns()))), 4 * pi, 0.02 * 4 * pi);
  for (std::size_t v = 0; v < on_skin.size(); ++v)
    if (!on_skin[v]) {
      EXPECT_EQ(places.normal[v], Point{});
    }
  EXPECT_TRUE(space.border("xmin").node.empty());
}

/// The Rayleigh quotient of a step of inverse iteration from `start`, without constants.
double eigenvalue(const TetSpace& space, SampleRule rule, const std::function<double(const Point&)>& start) {
  const SparseMatrix& m = *space.sampled(rule).mass;
  const SparseMatrix& k = *space.stiffness();
  SparseMatrix shifted = k;
  combine(1, k, 1, m, shifted);
  Vector u = values(space, start);
  const Vector ones = Vector::Ones(space.unknowns()), weight = m * ones;
  u -= u.dot(weight) / weight.sum() * ones;
  u = solve_spd(shifted, m * u);
  return u.dot(k * u) / u.dot(m * u);
}

double j0(double x) { return std::abs(x) < 1e-4 ? 1 : std::sin(x) / x; }
double j1(double x) { return std::abs(x) < 1e-3 ? x / 3 : (std::sin(x) / x - std::cos(x)) / x; }
double j2(double x) { return std::abs(x) < 1e-2 ? x * x / 15 : 3 * j1(x) / x - j0(x); }

/// Without flux through the skin the eigenvalues of the ball are squares of the roots of the derivatives of spherical
/// Bessel functions.
TEST(TetSpace, NeumannEigenvaluesOfTheBallAreOfSecondOrder) {
  constexpr double k1 = 2.081575977818101, k2 = 3.342093657365695, k0 = 4.493409457909064;
  const auto dipole = [](const Point& p) { return j1(k1 * length(p)) * p[0] / std::max(length(p), 1e-9); };
  const auto quadrupole = [](const Point& p) { return j2(k2 * length(p)) * p[0] * p[1] / std::max(dot(p, p), 1e-9); };
  const auto radial = [](const Point& p) { return j0(k0 * length(p)); };
  const TetSpace coarse(ball(0.2)), fine(ball(0.1));
  const std::pair<double, std::function<double(const Point&)>> modes[] = {{k1, dipole}, {k2, quadrupole}, {k0, radial}};
  for (const auto& [k, mode] : modes) {
    const auto error = [&](const TetSpace& space, SampleRule rule) {
      return eigenvalue(space, rule, mode) / (k * k) - 1;
    };
    // Those of the consistent mass have one sign.
    const double far = error(coarse, SampleRule::quadrature), near = error(fine, SampleRule::quadrature);
    const double blended = error(fine, SampleRule::vertices);
    std::printf("ball, k = %.4f: error of k^2 %.2e, with the blended mass %.2e\n", k, near, blended);
    EXPECT_GT(std::log2(far / near), 1.9) << k << ": " << far << " " << near;
    EXPECT_LT(std::abs(blended), 0.003) << k;
    EXPECT_LT(std::abs(blended), near) << k;
  }
}

TEST(TetSpace, TensorsFollowLinesInSpace) {
  const TetSpace space(ball(0.5));
  const std::size_t n = points_of(space);
  const Kinetics::TensorField rates{std::vector<double>(n, 0.0), std::vector<double>(n, 2.0),
                                    std::vector<double>(n, 1.0)};
  const Point d = unit(Point{1, 2, 2});
  const Eigen::Map<const Eigen::Vector3d> line(d.data());
  const Eigen::Matrix3d expected = Eigen::Matrix3d::Identity() + 3 * line * line.transpose();
  for (const std::vector<Tensor>& lines :
       {std::vector<Tensor>{line_tensor(d)},
        std::vector<Tensor>(static_cast<std::size_t>(space.unknowns()), line_tensor(d))})
    for (const Tensor& t : space.tensors(lines, rates)) EXPECT_LT((matrix_of(t) - expected).norm(), 1e-12);
  const Kinetics::TensorField turned{std::vector<double>(n, 0.3), rates.a1, rates.a2};
  EXPECT_THROW(space.tensors({line_tensor(d)}, turned), Error);
}

TEST(TetSpace, WhatReachesOutOfASetIsNotInside) {
  const TetMesh mesh = ball(0.5);
  const TetSpace space(mesh);
  std::vector<char> left(mesh.nodes());
  for (std::size_t v = 0; v < left.size(); ++v) left[v] = mesh.points[v][0] < 0;
  std::vector<char> expected = left;
  for (const Tetrahedron& t : mesh.tets)
    for (const Index a : t)
      for (const Index b : t)
        if (!left[static_cast<std::size_t>(b)]) expected[static_cast<std::size_t>(a)] = 0;
  EXPECT_EQ(space.interior(left), expected);
}

TEST(TetSpace, ThreadsDoNotMatterAndMovedSpacesAreThoseOfMovedNodes) {
  TetMesh mesh = ball(0.4);
  const TetSpace space(mesh);
  std::vector<double> expected;
  {
    const ThreadLimit one(1);
    expected = TetSpace(mesh).stiffness()->value;
  }
  EXPECT_EQ(space.stiffness()->value, expected);
  for (Point& p : mesh.points) p = {1.5 * p[0], p[1] + 0.1 * p[0], p[2]};
  const auto moved = space.moved(mesh.points);
  EXPECT_EQ(moved->stiffness()->value, TetSpace(mesh).stiffness()->value);
}

TEST(TetSpace, RefusesWhatIsNoVolume) {
  TetMesh mesh = ball(0.5);
  std::swap(mesh.tets[7][0], mesh.tets[7][1]);
  EXPECT_THROW(TetSpace{mesh}, Error);
  mesh.tets[7] = {0, 1, 2, static_cast<Index>(mesh.nodes())};
  EXPECT_THROW(TetSpace{mesh}, Error);
}

}  // namespace
}  // namespace pelage
