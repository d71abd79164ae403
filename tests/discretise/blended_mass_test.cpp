// Linear elements with a mass matrix between the lumped and the consistent one.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "discretise/method.h"
#include "discretise/sampling.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// A hexagon of equilateral triangles of edge 1 around vertex 0, two rings wide.
TriangleMesh lattice() {
  constexpr int rings = 2;
  TriangleMesh mesh;
  std::vector<std::array<int, 2>> places = {{0, 0}};
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j)
      if (std::abs(i + j) <= rings && (i != 0 || j != 0)) places.push_back({i, j});
  const auto number = [&](int i, int j) {
    return static_cast<Index>(std::ranges::find(places, std::array{i, j}) - places.begin());
  };
  const auto count = static_cast<Index>(places.size());
  for (const auto& [i, j] : places) mesh.points.push_back({i + 0.5 * j, std::sqrt(3.0) / 2 * j, 0});
  for (const auto& [i, j] : places) {
    const Index right = number(i + 1, j), up = number(i, j + 1), left_up = number(i - 1, j + 1);
    if (right < count && up < count) mesh.triangles.push_back({number(i, j), right, up});
    if (up < count && left_up < count) mesh.triangles.push_back({number(i, j), up, left_up});
  }
  return mesh;
}

/// k^2 of a plane wave as the matrices see it, relative to the true one: less 1.
double dispersion_error(double share, double k, double angle) {
  const TriangleMesh mesh = lattice();
  const Discretisation d = linear_discretisation(make_topology(mesh.points.size(), mesh.triangles));
  const Assembler assembler(d);
  const AssembledMatrices m = assembler.mass_and_stiffness(mesh.points);
  const Sampling s = blended_sampling(d, mesh.points, m.mass, m.stiffness, share);
  const SparseMatrix mass = sampled_mass(s, s.weight, assembler.pattern());
  Vector wave(d.unknowns);
  for (Index i = 0; i < d.unknowns; ++i) {
    const Point& p = mesh.points[static_cast<std::size_t>(i)];
    wave[i] = std::cos(k * (p[0] * std::cos(angle) + p[1] * std::sin(angle)));
  }
  return Vector(m.stiffness * wave)[0] / Vector(mass * wave)[0] / (k * k) - 1;
}

TEST(BlendedMass, HalfAndHalfCancelsTheLeadingErrorOfWaves) {
  for (const double angle : {0.0, 0.2, std::numbers::pi / 6}) {
    const double k = 2 * std::numbers::pi / 10;
    // k^2 (1 -+ (k h)^2 / 16) of the lumped and the consistent mass.
    EXPECT_NEAR(dispersion_error(0, k, angle), -k * k / 16, 0.1 * k * k / 16);
    EXPECT_NEAR(dispersion_error(1, k, angle), k * k / 16, 0.1 * k * k / 16);
    const double coarse = dispersion_error(0.5, k, angle), fine = dispersion_error(0.5, k / 2, angle);
    EXPECT_LT(std::abs(coarse), 2e-3);
    EXPECT_NEAR(coarse / fine, 16, 1) << "fourth order";
  }
}

TEST(BlendedMass, KeepsAreaAndLoadsReactionsAtTheNodes) {
  const auto topology = std::make_shared<const Topology>(make_topology(lattice().points.size(), lattice().triangles));
  const auto space = remeshed_method.make_space(topology, lattice().points);
  const SampledMass at_nodes = space->sampled(SampleRule::vertices);
  const Vector ones = Vector::Ones(space->unknowns());
  EXPECT_NEAR(ones.dot(*at_nodes.mass * ones), 24 * std::sqrt(3.0) / 4, 1e-12);
  const Vector f = Vector::Random(space->unknowns());
  EXPECT_LT((load(*at_nodes.sampling, f) - *at_nodes.mass * f).norm(), 1e-14);
  EXPECT_LT((coefficients_from_samples(*at_nodes.sampling, *at_nodes.mass, f) - f).norm(), 1e-10);
}

}  // namespace
}  // namespace pelage
