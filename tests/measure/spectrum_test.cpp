#include "measure/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "measure/slopes.h"
#include "shape/generators.h"

namespace pelage {
namespace {

using std::numbers::pi;

Spectrum of(const TriangleMesh& mesh, const std::function<double(const Point&)>& u, double near) {
  std::vector<double> values;
  for (const Point& p : mesh.points) values.push_back(u(p));
  return spectrum(*linear_space(mesh), values, near);
}

double share_between(const Spectrum& s, double low, double high) {
  double sum = 0;
  for (std::size_t i = 0; i < s.share.size(); ++i)
    if (s.wave_number[i] > low && s.wave_number[i] < high) sum += s.share[i];
  return sum;
}

/// k^2 = l (l + 1) for spherical harmonics of degree l; Legendre's polynomials have the variance 1 / (2 l + 1).
TEST(Spectrum, SphericalHarmonicsAreLines) {
  const TriangleMesh sphere = builtin_shape("builtin:sphere?n=10242");
  const auto p2 = [](double z) { return (3 * z * z - 1) / 2; };
  const auto p6 = [](double z) { return (231 * std::pow(z, 6) - 315 * std::pow(z, 4) + 105 * z * z - 5) / 16; };
  const Spectrum s = of(
      sphere, [&](const Point& p) { return p2(p[2]) + p6(p[0]); }, 4);
  const double two = 1.0 / 5, six = 1.0 / 13;
  EXPECT_NEAR(share_between(s, 2.4, 2.5), two / (two + six), 2e-3);
  EXPECT_NEAR(share_between(s, 6.4, 6.6), six / (two + six), 2e-3);
  EXPECT_NEAR(s.peak(), std::sqrt(6.0), 0.03);
}

/// The sum of the shares is 1; the mean of k^2 is Rayleigh's quotient.
TEST(Spectrum, ItsMomentsAreThoseOfTheFunction) {
  const TriangleMesh mesh = builtin_shape("builtin:torus?n=2000");
  std::vector<double> values;
  for (const Point& p : mesh.points) values.push_back(std::sin(5 * p[0]) * std::cos(3 * p[2] + 1) + 0.3 * p[1]);
  const auto space = linear_space(mesh);
  const Spectrum s = spectrum(*space, values, 5);
  const SparseMatrix mass = *space->sampled(SampleRule::quadrature).mass, stiffness = *space->stiffness();
  Vector u = Vector::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  const Vector ones = Vector::Ones(u.size());
  u.array() -= dot(ones, mass * u) / dot(ones, mass * ones);
  double sum = 0, mean = 0;
  for (std::size_t i = 0; i < s.share.size(); ++i) {
    sum += s.share[i];
    mean += s.share[i] * s.wave_number[i] * s.wave_number[i];
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(mean, dot(u, stiffness * u) / dot(u, mass * u), 1e-3 * mean);
}

TEST(Spectrum, AConstantHasNone) {
  EXPECT_TRUE(of(
                  builtin_shape("builtin:torus?n=500"), [](const Point&) { return 1.5; }, 3)
                  .empty());
}

/// Linear between the middles of the shares.
TEST(Spectrum, QuantilesLieBetweenTheMiddles) {
  Spectrum s;
  s.wave_number = {1, 2, 4};
  s.share = {0.25, 0.5, 0.25};
  EXPECT_EQ(s.quantile(0.1), 1);
  EXPECT_EQ(s.quantile(0.3125), 1.5);
  EXPECT_EQ(s.quantile(0.5), 2);
  EXPECT_EQ(s.quantile(1), 4);
}

}  // namespace
}  // namespace pelage
