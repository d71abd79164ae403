#include "discretise/gradients.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "discretise/surface_space.h"
#include "shape/generators.h"
#include "shape/vectors.h"
#include "support/discretisations.h"

namespace pelage {
namespace {

struct Case {
  std::string shape, method;
};

std::shared_ptr<const SurfaceSpace> space_of(const Case& c, int n) {
  const TriangleMesh mesh = builtin_shape("builtin:" + c.shape + "?n=" + std::to_string(n));
  Discretisation d = make_discretisation(c.method, make_topology(mesh.points.size(), mesh.triangles));
  std::vector<Point> control = c.method == "linear" ? mesh.points : loop_interpolation(*d.topology, mesh.points);
  return surface_space(std::move(d), std::move(control), 2);
}

Vector coefficients(const SurfaceSpace& space, const std::function<double(const Point&)>& f) {
  const SampledMass s = space.sampled(SampleRule::vertices);
  Vector samples(s.sampling->count());
  for (Eigen::Index i = 0; i < samples.size(); ++i) samples[i] = f(s.sampling->position[static_cast<std::size_t>(i)]);
  return coefficients_from_samples(*s.sampling, *s.mass, samples);
}

Vector noise(Index count, std::uint64_t seed) {
  Vector x(count);
  for (Index i = 0; i < count; ++i) x[i] = uniform(seed, static_cast<std::uint64_t>(i)) - 0.5;
  return x;
}

class GradientProducts : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, GradientProducts,
                         testing::Values(Case{"sphere", "linear"}, Case{"sphere", "loop"}, Case{"torus", "linear"},
                                         Case{"torus", "loop"}),
                         [](const auto& name) { return name.param.shape + "_" + name.param.method; });

Point normal_of(const std::string& shape, const Point& p) {
  if (shape == "sphere") return unit(p);
  const double ring = std::hypot(p[0], p[1]);  // of the circle in the torus
  return unit(Point{p[0] * (1 - 1 / ring), p[1] * (1 - 1 / ring), p[2]});
}

/// grad f . grad g with f = x + y z, g = z, from the gradients in space less what is normal.
double exact(const std::string& shape, const Point& p) {
  const Point n = normal_of(shape, p), f = {1, p[2], p[1]}, g = {0, 0, 1};
  return dot(f, g) - dot(f, n) * dot(g, n);
}

/// Root mean square of what products at the samples lack.
double error(const Case& c, SampleRule rule, int n) {
  const auto space = space_of(c, n);
  const Vector f = coefficients(*space, [](const Point& p) { return p[0] + p[1] * p[2]; });
  const Vector g = coefficients(*space, [](const Point& p) { return p[2]; });
  const Vector product = space->gradient_product(rule, f, g);
  const Sampling& s = *space->sampled(rule).sampling;
  double sum = 0;
  for (Eigen::Index i = 0; i < product.size(); ++i)
    sum += s.weight[i] * std::pow(product[i] - exact(c.shape, s.position[static_cast<std::size_t>(i)]), 2);
  return std::sqrt(sum / s.weight.sum());
}

/// Of second order, but for the twelve vertices of valence 5 of the sphere, around which gradients of Loop elements are
/// of order 1.5 in the mean, and for linear elements, inside of which they are constant.
TEST_P(GradientProducts, ConvergeToTheExactOnes) {
  const bool linear = GetParam().method == "linear", sphere = GetParam().shape == "sphere";
  for (const SampleRule rule : {SampleRule::vertices, SampleRule::quadrature}) {
    const double coarse = error(GetParam(), rule, 642), fine = error(GetParam(), rule, 2562);
    const double least = linear && rule == SampleRule::quadrature ? 0.9 : !linear && sphere ? 1.5 : 1.7;
    const double order = std::log2(coarse / fine);
    EXPECT_GT(order, least) << coarse << " " << fine;
    EXPECT_LT(fine, linear && rule == SampleRule::quadrature ? 0.05 : 0.012);
  }
}

/// integral of grad u . grad v = u' K v, whatever the functions: with v = u that is -integral of u lap u.
TEST_P(GradientProducts, IntegrateByParts) {
  const auto space = space_of(GetParam(), 300);
  const Vector u = noise(space->unknowns(), 1), v = noise(space->unknowns(), 2);
  const double expected = u.dot(*space->stiffness() * v), scale = u.dot(*space->stiffness() * u);
  const Vector product = space->gradient_product(SampleRule::quadrature, u, v);
  EXPECT_NEAR(space->sampled(SampleRule::quadrature).sampling->weight.dot(product), expected, 1e-12 * scale);
}

/// At the vertices of smooth functions, and the better the finer: the error falls with the square of the edge.
TEST_P(GradientProducts, IntegrateSmoothFunctionsByPartsAtTheVertices) {
  const auto error = [&](int n) {
    const auto space = space_of(GetParam(), n);
    const Vector u = coefficients(*space, [](const Point& p) { return p[0] + p[1] * p[2]; });
    const Vector product = space->gradient_product(SampleRule::vertices, u, u);
    const double expected = u.dot(*space->stiffness() * u);
    return std::abs(space->sampled(SampleRule::vertices).sampling->weight.dot(product) / expected - 1);
  };
  EXPECT_LT(error(642), 0.045);
  EXPECT_LT(error(2562), 0.012);
}

/// A peak is no slope: of one node that stands out among equal ones on an even mesh the gradient is 0.
TEST(GradientsAtVertices, OfAPeakAreNone) {
  const auto space = space_of({"torus", "linear"}, 2562);
  Vector u = Vector::Zero(space->unknowns());
  u[1000] = 1;
  const Vector product = space->gradient_product(SampleRule::vertices, u, u);
  EXPECT_LT(product[1000], 0.02 * product.maxCoeff());
}

}  // namespace
}  // namespace pelage
